#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include <vdbcage/core/export.h>

namespace vdbcage {

/// The base of every exception that the library throws on purpose. `what()` is one line for a person to read. Control
/// characters, which names of files and values may have, are written as codes.
class VDBCAGE_API Error : public std::runtime_error {
public:
    /// Makes an error with a message.
    /// \param text the message; control characters become codes
    explicit Error(const std::string& text);
    ~Error() override;
};

/// The error of an argument that is not acceptable. The message names it, its value and the allowed values. It is
/// thrown before any work is done, except where only the work shows it, such as a point outside of the cage.
class VDBCAGE_API InputError : public Error {
public:
    /// Makes an error without a subject.
    /// \param text the message; control characters become codes
    explicit InputError(const std::string& text);
    /// Makes an error whose message is "subject: problem".
    /// \param subject the argument, option or file, as subject() returns it
    /// \param problem the value and the allowed values
    InputError(const std::string& subject, const std::string& problem);
    ~InputError() override;

    /// Returns the name of the argument that is objected to, such as "model"; or of the option, such as "--faces"; or
    /// of the file. It is empty if the message names none.
    std::string subject() const;
    /// Returns the part of `what()` after the subject; all of it if there is none. A program that knows more about the
    /// subject, such as its file, throws this again with that name.
    std::string problem() const;

private:
    std::size_t subjectSize_ = 0; // a text of its own might throw where the exception is copied
};

/// The error of a file that could not be read or written. The message starts with its path.
class VDBCAGE_API IoError : public Error {
public:
    using Error::Error;
    ~IoError() override;
};

/// The error of a file that could not be read or written for lack of memory or of room on the disk. Another try or
/// another machine may do. Only functions that read or write files throw it: elsewhere lack of memory is
/// std::bad_alloc.
class VDBCAGE_API ResourceError : public IoError {
public:
    using IoError::IoError;
    ~ResourceError() override;
};

/// The error of a device, such as an OpenGL context, that is missing or failed. The message carries the driver's own
/// words.
class VDBCAGE_API DeviceError : public Error {
public:
    using Error::Error;
    ~DeviceError() override;
};

/// The exception that ends a function whose interrupter asked to stop. Nothing was written and no partial result
/// exists.
class VDBCAGE_API Cancelled : public Error {
public:
    /// Makes the exception; its message is "cancelled".
    Cancelled();
    ~Cancelled() override;
};

} // namespace vdbcage

#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include <vdbcage/core/export.h>

namespace vdbcage {

/// Base of every exception that the library throws on purpose. `what()` is one line for a person to read. Control
/// characters, which names of files and values may have, are written as codes.
class VDBCAGE_API Error : public std::runtime_error {
public:
    /// `what()` is `text`, each control character as a code.
    explicit Error(const std::string& text);
    ~Error() override;
};

/// A value handed in is not acceptable. The message names it, its value and the allowed values. Thrown before any work
/// is done, except where only the work shows it, such as a point outside of the cage.
class VDBCAGE_API InputError : public Error {
public:
    /// An objection without a subject.
    explicit InputError(const std::string& text);
    /// `what()` is "subject: problem".
    InputError(const std::string& subject, const std::string& problem);
    ~InputError() override;

    /// Names the argument that is objected to, such as "model"; or the option, such as "--faces"; or the file. Empty if
    /// the message names none.
    std::string subject() const;
    /// Says what is wrong with the subject: `what()` after it. A program that knows more about the subject, such as its
    /// file, throws this again with that name.
    std::string problem() const;

private:
    std::size_t subjectSize_ = 0; // a text of its own might throw where the exception is copied
};

/// A file could not be read or written. The message starts with its path.
class VDBCAGE_API IoError : public Error {
public:
    using Error::Error;
    ~IoError() override;
};

/// A file could not be read or written for lack of memory or of room on the disk. Another try or another machine may
/// do. Only what reads or writes files throws it: elsewhere lack of memory is std::bad_alloc.
class VDBCAGE_API ResourceError : public IoError {
public:
    using IoError::IoError;
    ~ResourceError() override;
};

/// A device, such as an OpenGL context, is missing or failed. The message carries the driver's own words.
class VDBCAGE_API DeviceError : public Error {
public:
    using Error::Error;
    ~DeviceError() override;
};

/// The interrupter asked to stop. Nothing was written and no partial result exists.
class VDBCAGE_API Cancelled : public Error {
public:
    /// `what()` is "cancelled".
    Cancelled();
    ~Cancelled() override;
};

} // namespace vdbcage

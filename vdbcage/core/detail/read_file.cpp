#include <vdbcage/core/detail/read_file.h>

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <vdbcage/core/detail/io_failure.h>
#include <vdbcage/core/error.h>

namespace vdbcage::detail {

namespace {

/// An open file, closed when the scope is left.
class File {
public:
    explicit File(const std::filesystem::path& path)
        : path_(path), descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC))
    {
        if (descriptor_ < 0) fail(errno);
    }
    ~File() { ::close(descriptor_); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    std::string readAll() const
    {
        struct stat status {};
        if (::fstat(descriptor_, &status) != 0) fail(errno);
        std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
        std::size_t got = 0;
        while (got < bytes.size()) {
            const ssize_t count = ::read(descriptor_, bytes.data() + got, bytes.size() - got);
            if (count < 0 && errno != EINTR) fail(errno);
            if (count == 0) break; // it became shorter in the meantime
            if (count > 0) got += static_cast<std::size_t>(count);
        }
        bytes.resize(got);
        return bytes;
    }

private:
    [[noreturn]] void fail(int error) const { throwIoError(path_.string() + ": cannot be read", error); }

    const std::filesystem::path& path_;
    int descriptor_;
};

} // namespace

void requireRegularFile(const std::filesystem::path& path)
{
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (std::filesystem::is_directory(status)) throw IoError(path.string() + ": is a directory; a file is needed");
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        throw IoError(path.string() + ": is not a regular file");
    }
}

std::string readFile(const std::filesystem::path& path)
{
    requireRegularFile(path);
    std::string bytes = File(path).readAll();
    if (bytes.empty()) throw IoError(path.string() + ": the file is empty; copy or export it again");
    return bytes;
}

} // namespace vdbcage::detail

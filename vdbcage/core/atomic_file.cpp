#include <vdbcage/core/atomic_file.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

#include <sys/stat.h>
#include <unistd.h>

#include <vdbcage/core/error.h>

namespace vdbcage {

namespace {

namespace fs = std::filesystem;

std::string reason(int error)
{
    return std::generic_category().message(error);
}

fs::path folderOf(const fs::path& file)
{
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// A file of its own in the folder of `target`, removed unless it was committed.
class TemporaryFile {
public:
    explicit TemporaryFile(const fs::path& target) : target_(target)
    {
        requireWritable(target);
        const fs::path folder = folderOf(target);
        // mkstemps creates the file exclusively; the extension is kept for writers that look at it.
        const std::string extension = target.extension().string();
        std::string name = (folder / ("." + target.stem().string() + ".XXXXXX" + extension)).string();
        const int descriptor = ::mkstemps(name.data(), static_cast<int>(extension.size()));
        if (descriptor < 0) throw IoError(target.string() + ": cannot be written: " + reason(errno));
        path_ = name;
        // mkstemps makes files private; give this one the permissions an ordinary new file would get, or those of
        // the file it is going to replace.
        struct stat existing {};
        if (::stat(target.c_str(), &existing) == 0) {
            ::fchmod(descriptor, existing.st_mode & 07777U);
        } else {
            const mode_t mask = ::umask(0);
            ::umask(mask);
            ::fchmod(descriptor, 0666U & ~mask);
        }
        ::close(descriptor);
    }
    ~TemporaryFile()
    {
        if (!committed_) {
            std::error_code ignored;
            fs::remove(path_, ignored);
        }
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    const fs::path& path() const { return path_; }
    void commit()
    {
        std::error_code error;
        fs::rename(path_, target_, error);
        if (error) throw IoError(target_.string() + ": cannot be written: " + error.message());
        committed_ = true;
    }

private:
    fs::path target_, path_;
    bool committed_ = false;
};

} // namespace

void requireWritable(const fs::path& path)
{
    std::error_code error;
    const fs::path folder = folderOf(path);
    if (path.filename().empty() || fs::is_directory(path, error)) {
        throw IoError(path.string() + ": is a directory; a file is needed");
    }
    if (!fs::is_directory(folder, error)) {
        throw IoError(path.string() + ": the folder " + folder.string() + " does not exist");
    }
    if (fs::exists(path, error)) {
        if (!fs::is_regular_file(path, error)) throw IoError(path.string() + ": is not an ordinary file");
        if (::access(path.c_str(), W_OK) != 0) throw IoError(path.string() + ": cannot be replaced: " + reason(errno));
    }
    if (::access(folder.c_str(), W_OK) != 0) throw IoError(path.string() + ": cannot be written: " + reason(errno));
}

void writeFileAtomically(const fs::path& path, const std::function<void(std::ostream&)>& write)
{
    TemporaryFile file(path);
    errno = 0;
    std::ofstream stream(file.path(), std::ios::binary | std::ios::trunc);
    if (stream) write(stream);
    stream.close();
    if (!stream) {
        throw IoError(path.string() + ": cannot be written: " + (errno != 0 ? reason(errno) : "the stream failed"));
    }
    file.commit();
}

void writePathAtomically(const fs::path& path, const std::function<void(const fs::path&)>& write)
{
    TemporaryFile file(path);
    write(file.path());
    file.commit();
}

} // namespace vdbcage

#include <vdbcage/core/detail/atomic_file.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <random>
#include <streambuf>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <vdbcage/core/detail/io_failure.h>
#include <vdbcage/core/error.h>

namespace vdbcage {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& target, int error)
{
    detail::throwIoError(target.string() + ": cannot be written", error);
}

fs::path folderOf(const fs::path& file)
{
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// Returns a name that nobody else uses: 64 random bits are unique among processes, hosts and runs.
fs::path hiddenName(const fs::path& folder)
{
    std::random_device random;
    std::uint64_t bits = (std::uint64_t{random()} << 32U) | random();
    std::string name = ".vdbcage-0000000000000000";
    for (std::size_t i = name.size(); i-- > 9; bits >>= 4U) name[i] = "0123456789abcdef"[bits & 15U];
    return folder / name;
}

/// Returns the target of a symbolic link, whether it exists or not; `target` itself if it is no link.
fs::path followed(const fs::path& target)
{
    std::error_code error;
    if (!fs::is_symlink(fs::symlink_status(target, error))) return target;
    fs::path file = fs::weakly_canonical(target, error);
    if (error) fail(target, error.value());
    return file;
}

/// The buffer of a stream that writes to a descriptor. It keeps the reason of the first failure, which streams and
/// errno lose.
class DescriptorBuffer : public std::streambuf {
public:
    explicit DescriptorBuffer(int descriptor) : descriptor_(descriptor) { setp(buffer_.data(), end()); }
    int error() const { return error_; }

protected:
    int_type overflow(int_type c) override
    {
        if (!flush()) return traits_type::eof();
        return traits_type::eq_int_type(c, traits_type::eof()) ? traits_type::not_eof(c)
                                                               : sputc(traits_type::to_char_type(c));
    }
    int sync() override { return flush() ? 0 : -1; }
    pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode /*which*/) override
    {
        if (!flush()) return -1;
        const int whence = from == std::ios_base::beg ? SEEK_SET : from == std::ios_base::cur ? SEEK_CUR : SEEK_END;
        return ::lseek(descriptor_, offset, whence);
    }
    pos_type seekpos(pos_type position, std::ios_base::openmode which) override
    {
        return seekoff(position, std::ios_base::beg, which);
    }

private:
    char* end() { return buffer_.data() + buffer_.size(); }
    bool flush()
    {
        for (const char* at = pbase(); at != pptr() && error_ == 0;) {
            const ssize_t count = ::write(descriptor_, at, static_cast<std::size_t>(pptr() - at));
            if (count >= 0) {
                at += count;
            } else if (errno != EINTR) {
                error_ = errno;
            }
        }
        setp(buffer_.data(), end());
        return error_ == 0;
    }

    const int descriptor_;
    int error_ = 0;
    std::array<char, 1U << 16U> buffer_;
};

} // namespace

void requireWritable(const fs::path& path)
{
    struct stat status {};
    const bool exists = ::stat(path.c_str(), &status) == 0;
    const int reason = exists ? 0 : errno;
    if (path.filename().empty() || (exists && S_ISDIR(status.st_mode))) {
        throw IoError(path.string() + ": is a directory; a file is needed");
    }
    const fs::path folder = folderOf(followed(path));
    std::error_code error;
    if (!fs::is_directory(folder, error)) {
        if (error && error.value() != ENOENT && error.value() != ENOTDIR) fail(path, error.value());
        throw IoError(path.string() + ": the folder " + folder.string() + " does not exist");
    }
    if (!exists && reason != ENOENT) fail(path, reason);
    if (exists && !S_ISREG(status.st_mode)) throw IoError(path.string() + ": is not an ordinary file");
    if (exists && ::access(path.c_str(), W_OK) != 0) {
        throw IoError(path.string() + ": cannot be replaced: " + std::generic_category().message(errno));
    }
    if (::access(folder.c_str(), W_OK) != 0) fail(path, errno);
    struct stat ignored {};
    if (::lstat(hiddenName(folder).c_str(), &ignored) != 0 && errno != ENOENT) fail(path, errno);
}

/// A temporary file, its target, and, during a commit, the file that was there.
class PendingFiles::File {
public:
    explicit File(fs::path target) : target_(std::move(target)), place_(followed(target_)) {}
    ~File()
    {
        if (descriptor_ >= 0) ::close(descriptor_);
        if (isMade(temporary_)) ::unlink(temporary_.c_str());
        if (hasOld_) ::unlink(old_.c_str());
    }
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    void make()
    {
        requireWritable(target_);
        const fs::path folder = folderOf(place_);
        struct stat existing {};
        isNew_ = ::stat(place_.c_str(), &existing) != 0;
        old_ = hiddenName(folder);
        do {
            temporary_ = hiddenName(folder);
            descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        } while (descriptor_ < 0 && errno == EEXIST);
        if (descriptor_ < 0 || ::fstat(descriptor_, &made_) != 0) fail(errno);
        if (isNew_) return;
        // The owner first, since changing it removes some permissions. Only root and members of the group may do so.
        static_cast<void>(::fchown(descriptor_, existing.st_uid, existing.st_gid) == 0);
        if (::fchmod(descriptor_, existing.st_mode & 07777U) != 0) fail(errno);
    }

    void fill(const FileWriter& write)
    {
        DescriptorBuffer buffer(descriptor_);
        std::ostream stream(&buffer);
        write(stream);
        stream.flush();
        const bool isGood = static_cast<bool>(stream);
        if (::fstat(descriptor_, &made_) != 0) fail(errno);
        const int error = ::close(std::exchange(descriptor_, -1)) == 0 ? buffer.error() : errno;
        if (error != 0) fail(error);
        if (!isGood) throw IoError(target_.string() + ": cannot be written: the stream failed");
    }

    /// \param keepOld whether `restore` may follow
    void replace(bool keepOld)
    {
        if (!isMade(temporary_)) {
            throw IoError(target_.string() + ": cannot be written: another process took the temporary file " +
                          temporary_.string() + " away");
        }
        // Some file systems have no hard links; then there is nothing to restore.
        hasOld_ = keepOld && !isNew_ && ::link(place_.c_str(), old_.c_str()) == 0;
        if (::rename(temporary_.c_str(), place_.c_str()) != 0) fail(errno);
    }

    /// Undoes replace(). Returns false if that is impossible.
    bool restore() noexcept
    {
        isBack_ = !isMade(place_) || // by now another program's file
                  (isNew_ ? ::unlink(place_.c_str()) == 0 : hasOld_ && ::rename(old_.c_str(), place_.c_str()) == 0);
        isKept_ = !isBack_ && hasOld_;
        hasOld_ = false;
        return isBack_;
    }
    /// Returns the hint for a person about a file that could not be restored.
    std::string remains() const
    {
        if (isBack_) return {};
        return "; " + target_.string() + (isNew_ ? " was made" : " was replaced") +
               (isKept_ ? ", what it held is in " + old_.string() : "");
    }

private:
    [[noreturn]] void fail(int error) const { vdbcage::fail(target_, error); }

    /// Returns whether the file made here, and no other, is at `path`. The number of a removed file is soon reused.
    bool isMade(const fs::path& path) const
    {
        struct stat found {};
        if (::lstat(path.c_str(), &found) != 0) return false;
        const bool isSameFile = found.st_dev == made_.st_dev && found.st_ino == made_.st_ino && S_ISREG(found.st_mode);
        if (descriptor_ >= 0) return isSameFile; // while it is open, no other file gets its number
        return isSameFile && found.st_size == made_.st_size && found.st_mtim.tv_sec == made_.st_mtim.tv_sec &&
               found.st_mtim.tv_nsec == made_.st_mtim.tv_nsec;
    }

    fs::path target_;                      // as given, for messages
    fs::path place_;                       // the same, with links followed
    fs::path temporary_;                   // beside it
    fs::path old_;                         // a second name of the file that was there
    struct stat made_ {};                  // of the temporary file
    bool isNew_ = false;                   // nothing was there
    bool hasOld_ = false;                  // `old_` exists; the destructor removes it
    bool isBack_ = false, isKept_ = false; // after restore(): whether all is as before; whether `old_` stays
    int descriptor_ = -1;
};

PendingFiles::PendingFiles() = default;
PendingFiles::~PendingFiles() = default;

void PendingFiles::add(const fs::path& target, const FileWriter& write)
{
    files_.push_back(std::make_unique<File>(target)); // first, so that clear() always knows of it
    try {
        files_.back()->make();
        files_.back()->fill(write);
    } catch (...) {
        files_.pop_back();
        throw;
    }
}

void PendingFiles::commit()
{
    std::size_t done = 0;
    try {
        for (; done < files_.size(); ++done) files_[done]->replace(done + 1 < files_.size());
    } catch (const IoError& error) {
        const std::vector<std::unique_ptr<File>> files = std::move(files_);
        bool isAllBack = true;
        for (std::size_t i = done; i-- > 0;) isAllBack = files[i]->restore() && isAllBack;
        if (isAllBack) throw;
        std::string text = error.what();
        for (std::size_t i = 0; i < done; ++i) text += files[i]->remains();
        if (dynamic_cast<const ResourceError*>(&error)) throw ResourceError(text);
        throw IoError(text);
    } catch (...) {
        for (std::size_t i = done; i-- > 0;) files_[i]->restore();
        throw;
    }
    files_.clear();
}

void PendingFiles::clear() noexcept
{
    files_.clear();
}

void writeFileAtomically(const fs::path& path, const FileWriter& write)
{
    PendingFiles file;
    file.add(path, write);
    file.commit();
}

} // namespace vdbcage

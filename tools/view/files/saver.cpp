#include <tools/view/files/saver.h>

#include <utility>

#include <tools/files/frames.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

Saver::Saver(std::function<void()> wake)
    : worker_(
          [](const Job& job, Interrupter& interrupter, const auto&) {
              job.write(&interrupter);
              return job.name;
          },
          std::move(wake))
{
}

void Saver::save(const std::filesystem::path& path, bool isSequence,
                 const std::function<Write(const std::filesystem::path&)>& makeWriter)
{
    if (isBusy_) throw InputError(path.string(), "another file is still being written");
    const std::filesystem::path file = isSequence ? files::patternFor(path) : path;
    Write write = makeWriter(file);
    isBusy_ = true;
    worker_.start({file.filename().string(), std::move(write)});
}

std::optional<std::string> Saver::take()
{
    const auto outcome = worker_.take();
    if (!outcome) return std::nullopt;
    isBusy_ = false;
    if (!outcome->error.empty()) throw InputError(outcome->error);
    return outcome->result;
}

} // namespace vdbcage::view

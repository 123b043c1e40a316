#include <tools/view/state/command.h>

#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace {

using Table = LineTable<Command>;

template <class T, class Of>
void add(std::vector<Command>& list, const Of& of)
{
    list.emplace_back(T(of));
}
template <class T>
void add(std::vector<Command>& list, const std::vector<T>& all)
{
    list.insert(list.end(), all.begin(), all.end());
}

template <class T>
void addFor(const ViewState& view, std::vector<Command>& list)
{
    if constexpr (changesView<T>) add<T>(list, T::of(view));
}

template <class... Each>
std::vector<Command> listFor(const ViewState& view, const std::variant<Each...>* /*type*/)
{
    std::vector<Command> list;
    (addFor<Each>(view, list), ...);
    return list;
}

} // namespace

bool changesDocument(const Command& command)
{
    return std::visit([](const auto& each) { return !changesView<std::decay_t<decltype(each)>>; }, command);
}

std::string toText(const Command& command)
{
    return Table::text(command);
}

Command commandOf(const Words& words)
{
    if (auto command = tryCommandOf(words)) return *std::move(command);
    throw InputError("'" + (words.empty() ? std::string() : words[0]) + "' is not a command");
}

std::optional<Command> tryCommandOf(const Words& words)
{
    return Table::read(words);
}

LineHelp describeCommands()
{
    return Table::help();
}

std::vector<Command> commandsFor(const ViewState& view)
{
    return listFor(view, static_cast<const Command*>(nullptr));
}

State applied(const State& state, const Command& command, const PosableCagePtr& cage, std::string* remark)
{
    State changed = state;
    const auto apply = [&](const auto& each) {
        if constexpr (changesView<std::decay_t<decltype(each)>>) {
            each.apply(changed.view);
        } else {
            each.apply(changed.document, Situation{state, cage, nullptr, remark});
        }
    };
    std::visit(apply, command);
    return changed;
}

} // namespace vdbcage::view

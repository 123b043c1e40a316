#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <openvdb/Types.h>
#include <tools/view/state/words.h>
#include <vdbcage/core/range.h>

/// Lines of scripts. In the program a line is a value: a struct of its own, with its row of the table:
///
///     static LineInfo info();                     // its name and its help
///     static T read(const Arguments& arguments);  // or a value that converts to T; none for a line of its name alone
///     std::string text() const;                   // its arguments, by written(); none for a line of its name alone
///
/// Text is only for scripts, records and help.
namespace vdbcage::view {

/// The syntax of a line, and its help.
struct LineInfo {
    std::string name;
    std::string arguments; ///< as in the help
    std::size_t least = 0; ///< words after the name
    std::size_t most = 0;
    std::string help;
};
constexpr std::size_t anyNumber = ~std::size_t{0};

/// The words of a line after its name. Each function throws InputError with the name, the word and the allowed values.
class Arguments {
public:
    /// \pre there is a name
    explicit Arguments(const Words& line) : name_(line.front()), words_(line.begin() + 1, line.end()) {}

    const std::string& name() const { return name_; }
    const Words& words() const { return words_; }
    std::size_t count() const { return words_.size(); }
    const std::string& operator[](std::size_t i) const { return words_[i]; }

    double number(std::size_t i) const { return numberOf(words_[i], name_); }
    double number(std::size_t i, const Range& range) const;
    int whole(std::size_t i, int least, int most) const { return wholeNumberOf(words_[i], name_, least, most); }
    bool isOn(std::size_t i) const { return switchOf(words_[i], name_); }
    /// Returns the vector in the three words from the i-th on.
    openvdb::Vec3d vector(std::size_t i) const { return {number(i), number(i + 1), number(i + 2)}; }
    /// Returns the value of a name in the list; the first name is value 0.
    template <class Enum, std::size_t count>
    Enum choice(std::size_t i, const std::array<const char*, count>& names) const
    {
        return static_cast<Enum>(placeAmong(i, names.data(), count));
    }

    /// \throw InputError "NAME: " and the problem
    [[noreturn]] void fail(const std::string& problem) const;

private:
    std::size_t placeAmong(std::size_t i, const char* const* names, std::size_t count) const;

    std::string name_;
    Words words_;
};

/// Returns the name of a value in a list of names.
template <class Enum, std::size_t count>
const char* nameIn(const std::array<const char*, count>& names, Enum value)
{
    const char* const* const first = names.data(); // GCC 12 mixes up the sizes of lists that it inlines
    return first[static_cast<std::size_t>(value)];
}

/// Return the words of values, each after a blank.
std::string written(double value);
std::string written(int value);
std::string written(bool isOn);
std::string written(const char* word);
std::string written(const std::string& word);
std::string written(const openvdb::Vec3d& vector);
template <class First, class... Others, class = std::enable_if_t<(sizeof...(Others) > 0)>>
std::string written(const First& first, const Others&... others)
{
    return written(first) + written(others...);
}

/// Usage and help of each line.
using LineHelp = std::vector<std::pair<std::string, std::string>>;

/// The table of all lines that `Line`, a std::variant of their structs, can be. Help has them in its order.
template <class Line>
class LineTable;

template <class... Each>
class LineTable<std::variant<Each...>> {
public:
    using Line = std::variant<Each...>;

    /// Returns the line in `words`; none: no line has that name. \throw InputError naming the line, the word and the
    /// allowed values
    static std::optional<Line> read(const Words& words)
    {
        for (const Row& row : rows()) {
            if (words.empty() || words[0] != row.info.name) continue;
            const Arguments arguments(words);
            if (arguments.count() < row.info.least || arguments.count() > row.info.most) {
                arguments.fail("it is written " + usage(row.info));
            }
            return row.read(arguments);
        }
        return std::nullopt;
    }

    /// Returns the text without a line break; read() makes an equal line of its words.
    static std::string text(const Line& line)
    {
        const auto arguments = [](const auto& each) {
            if constexpr (std::is_empty_v<std::decay_t<decltype(each)>>) {
                return std::string();
            } else {
                return each.text();
            }
        };
        return rows()[line.index()].info.name + std::visit(arguments, line);
    }

    static LineHelp help()
    {
        LineHelp list;
        for (const Row& row : rows()) list.emplace_back(usage(row.info), row.info.help);
        return list;
    }

private:
    struct Row {
        LineInfo info;
        Line (*read)(const Arguments&);
    };

    template <class T>
    static Line readAs(const Arguments& arguments)
    {
        if constexpr (std::is_empty_v<T>) {
            return T{};
        } else {
            return T(T::read(arguments));
        }
    }

    static const std::vector<Row>& rows()
    {
        static const std::vector<Row> list{{Each::info(), readAs<Each>}...};
        return list;
    }

    static std::string usage(const LineInfo& info)
    {
        return info.name + (info.arguments.empty() ? "" : " ") + info.arguments;
    }
};

} // namespace vdbcage::view

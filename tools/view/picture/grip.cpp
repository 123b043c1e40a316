#include <tools/view/picture/grip.h>

#include <array>
#include <cmath>
#include <vector>

#include <tools/view/state/words.h>
#include <vdbcage/core/detail/length_text.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace {

using openvdb::Vec3d;

constexpr double snappedDegrees = 15, snappedFactor = 0.1;

/// Returns numbers separated by spaces; words that cannot be read are 0.
std::vector<double> numbersIn(const std::string& text)
{
    std::vector<double> numbers;
    for (const std::string& word : wordsOf(text)) {
        try {
            numbers.push_back(numberOf(word, "number"));
        } catch (const InputError&) { // an incomplete number, such as "-"
            numbers.push_back(0);
        }
    }
    return numbers;
}

} // namespace

void Grip::moveTo(const Pixel& at, bool isSnapping)
{
    at_ = at;
    isSnapping_ = isSnapping;
}

void Grip::press(const KeyDown& down, const Modifiers& modifiers)
{
    const std::string name = nameOf(down.key);
    if (down.key >= Key::x && down.key <= Key::z) {
        const int axis = static_cast<int>(down.key) - static_cast<int>(Key::x);
        const Handle wanted{modifiers.shift ? Handle::Kind::plane : Handle::Kind::axis, axis};
        // The same key again removes the choice.
        start_.handle = start_.handle == wanted ? Handle{} : wanted;
    } else if (down.key == Key::backspace) {
        if (!typed_.empty()) typed_.pop_back();
    } else if (down.key == Key::period || down.key == Key::keypadDecimal) {
        typed_ += '.';
    } else if (down.key == Key::minus || down.key == Key::keypadSubtract) {
        typed_ += '-';
    } else if (down.key == Key::tab) {
        typed_ += ' ';
    } else if (!name.empty() && name.back() >= '0' && name.back() <= '9' &&
               (name.size() == 1 || name.rfind("keypad-", 0) == 0)) {
        typed_ += name.back();
    }
}

double Grip::snappingStep() const
{
    return start_.tool == Tool::rotate  ? snappedDegrees
           : start_.tool == Tool::scale ? snappedFactor
                                        : start_.gridStep / 10;
}

Amount Grip::amount() const
{
    const Handle& handle = start_.handle;
    Amount amount = draggedAmount(start_.frame, start_.tool, handle, start_.at, at_);
    if (start_.tool == Tool::move) amount.values *= start_.unit;
    if (isSnapping_) {
        const double step = snappingStep();
        for (int k = 0; k < 3; ++k) amount.values[k] = std::round(amount.values[k] / step) * step;
    }
    const std::vector<double> typed = numbersIn(typed_);
    if (typed.empty()) return amount;
    if (start_.tool == Tool::rotate) {
        amount.values[0] = typed[0];
        return amount;
    }
    // The numbers are for the axes that can be set, in order. A single factor scales all of them.
    amount.values = Vec3d(start_.tool == Tool::scale ? 1 : 0);
    std::size_t next = 0;
    for (int k = 0; k < 3; ++k) {
        const bool isSet =
            handle.kind == Handle::Kind::screen || (handle.kind == Handle::Kind::axis) == (k == handle.axis);
        if (!isSet) continue;
        if (next < typed.size()) {
            amount.values[k] = typed[next++];
        } else if (start_.tool == Tool::scale && typed.size() == 1) {
            amount.values[k] = typed[0];
        }
    }
    return amount;
}

Command Grip::command() const
{
    const Vec3d by = amount().values;
    const std::array<Vec3d, 3>& axes = start_.frame.axes;
    if (start_.tool == Tool::move) return MoveSelected{axes[0] * by[0] + axes[1] * by[1] + axes[2] * by[2]};
    if (start_.tool == Tool::rotate) {
        return RotateSelected{rotationAxis(start_.frame, start_.handle), by[0], start_.pivot};
    }
    return ScaleSelected{by, start_.pivot, {axes[0], axes[1]}};
}

std::string Grip::describe(Orientation orientation) const
{
    const Amount by = amount();
    static constexpr std::array<const char*, 4> verbs{"", "Move", "Rotate", "Scale"};
    std::string text = nameIn(verbs, start_.tool);
    if (start_.handle.kind != Handle::Kind::screen) {
        text += start_.handle.kind == Handle::Kind::axis ? " along " : " across ";
        text += static_cast<char>('X' + start_.handle.axis);
        text += std::string(", ") + nameIn(orientationNames, orientation);
    }
    const auto number = [&](int k) { return detail::lengthText(by.values[k], snappingStep() / 1000); };
    text += ": " + number(0);
    text += start_.tool == Tool::rotate ? " degrees" : "  " + number(1) + "  " + number(2);
    if (!typed_.empty()) text += "   [" + typed_ + "]";
    return text;
}

} // namespace vdbcage::view

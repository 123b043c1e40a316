#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <tools/view/input/input.h>
#include <tools/view/widgets/drawing.h>

namespace vdbcage::view {

/// Where text goes that is cut or copied in a text field, and where pasted text comes from.
struct Clipboard {
    std::function<std::string()> get;
    std::function<void(const std::string&)> set;
};

/// What the pointer should look like.
enum class PointerShape { arrow, text, hand, resizeHorizontally, resizeVertically };

/// The panels of one window: Dear ImGui with the font, the style and the events of this program. It needs no OpenGL.
/// Its outcome depends on the events and on what is built only: no clock is asked, no file is read or written.
/// Several may exist; each is used by one thread at a time, and only one on a thread lays out at a moment.
class Widgets {
public:
    /// Calls ImGui to say what there is, and learns from it what the user did. It is called more than once an event,
    /// but each thing that the user does is told to it once.
    using Build = std::function<void()>;

    /// `scale`: pixels that a length of 1 has, 1 on an ordinary screen. A clipboard without both functions is not
    /// used; there is a private one then.
    /// \throw InputError the scale is not in [0.5, 8]
    /// Cost: 15 to 40 ms, for the glyphs.
    explicit Widgets(float scale, Clipboard clipboard = {});
    ~Widgets();
    Widgets(const Widgets&) = delete;
    Widgets& operator=(const Widgets&) = delete;

    /// Lays the panels out in `width` x `height` pixels. To be called for each event, and with null where something
    /// else changed that `build` shows.
    /// `build` is called with the event, and then without until two drawings in a row are the same: ImGui hides a
    /// window while it learns its size, and answers some events one layout later. So each event meets what a user sees
    /// who waits between events, and none is lost. After `mostLayouts` calls the last drawing is taken as it is.
    /// An exception of `build` ends the layout and comes out; the widgets can still be used.
    /// Returns whether the event is for the widgets, rather than for what is behind them. A release is for whom the
    /// press was.
    /// Cost: for two panels and 2,700 vertices 0.08 ms an event.
    bool layOut(const InputEvent* event, int width, int height, const Build& build);

    static constexpr int mostLayouts = 5;

    /// What the last layout looks like.
    const Drawing& drawing() const;

    /// Another number after each `layOut` that changed the drawing.
    std::uint64_t version() const;

    const Glyphs& glyphs() const;

    /// Whether the pointer is over a panel, or drags something of one.
    bool wantsPointer() const;
    /// Whether keys go to a text field, an open popup or what is being dragged. Of a popup arrows, enter and escape
    /// choose.
    bool wantsKeyboard() const;
    /// Whether a text field takes what is typed.
    bool wantsText() const;
    PointerShape pointerShape() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

// The rest is for use within `Widgets::Build`.

/// A line of text in the semibold.
void heading(const std::string& text);

/// The heading of a part of a panel that the user can fold up; `open` at first. Whether the part is to be built.
bool section(const std::string& title, bool open = true);

/// The one button of a panel that does what the panel is for. `width` in pixels; 0: as the text needs, -1: all there
/// is. Whether it was pressed.
bool mainButton(const std::string& label, float width = 0);

/// Pixels that a length of 1 has.
float scale();

} // namespace vdbcage::view

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <tools/view/input/input.h>
#include <tools/view/widgets/drawing.h>

namespace vdbcage::view {

/// The target of text that is cut or copied in a text field, and the source of pasted text.
struct Clipboard {
    std::function<std::string()> get;
    std::function<void(const std::string&)> set;
};

/// The shape of the pointer.
enum class PointerShape { arrow, text, hand, resizeHorizontally, resizeVertically };

/// The panels of one window: Dear ImGui with the font, the style and the events of this program. It needs no OpenGL.
/// Its result depends only on the events and on the panels that are built: no clock is asked, no file is read or
/// written. Several may exist; each is used by one thread at a time, and a thread lays out one at a time.
class Widgets {
public:
    /// A function that builds the panels by calls of ImGui, which return the user's acts. It is called more than once
    /// for an event, but each act is reported to it once.
    using Build = std::function<void()>;

    /// `scale`: pixels per unit of length, 1 on an ordinary screen. Only a clipboard with both functions is used; else
    /// there is a private one.
    /// \throw InputError the scale is not in [0.5, 8]
    /// Cost: 15 to 40 ms, for the glyphs.
    explicit Widgets(float scale, Clipboard clipboard = {});
    ~Widgets();
    Widgets(const Widgets&) = delete;
    Widgets& operator=(const Widgets&) = delete;

    /// Lays out the panels in `width` x `height` pixels. Call it for each event, and with null if other content of the
    /// panels changed.
    /// `build` is called with the event, and then with none until two drawings in a row are the same: ImGui hides a
    /// window while it learns its size, and answers some events one layout later. So each event meets the panels as a
    /// user would who waits between events, and none is lost. After `mostLayouts` calls the last drawing is taken.
    /// An exception of `build` ends the layout and is passed on; the widgets can still be used.
    /// Returns whether the event is for the widgets, rather than for the picture behind them. A release goes where its
    /// press went.
    /// Cost: for two panels and 2,700 vertices 0.08 ms per event.
    bool layOut(const InputEvent* event, int width, int height, const Build& build);

    static constexpr int mostLayouts = 5;

    /// Returns the drawing of the last layout.
    const Drawing& drawing() const;

    /// Returns a number that changes with each `layOut` that changed the drawing.
    std::uint64_t version() const;

    const Glyphs& glyphs() const;

    /// Returns whether the pointer is over a panel, or drags a part of one.
    bool wantsPointer() const;
    /// Returns whether keys go to a text field, an open popup or the item that is being dragged. In a popup, arrows,
    /// enter and escape choose.
    bool wantsKeyboard() const;
    /// Returns whether a text field takes typed text.
    bool wantsText() const;
    PointerShape pointerShape() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

// The functions below are for use within `Widgets::Build`.

/// Adds a line of text in the semibold font.
void heading(const std::string& text);

/// Adds the heading of a part that the user can fold; `open` at first. Returns whether the part is to be built.
bool section(const std::string& title, bool open = true);

/// Adds the main button of a panel. `width` in pixels; 0: as the text needs, -1: all that is free. Returns whether it
/// was pressed.
bool mainButton(const std::string& label, float width = 0);

/// Returns the pixels per unit of length.
float scale();

} // namespace vdbcage::view

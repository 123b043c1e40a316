#pragma once

#include <map>
#include <optional>
#include <string>

#include <tools/view/panels/context.h>
#include <tools/view/panels/file_browser.h>

/// The parts of the window; each is built once a layout. Those that remember something take it.
namespace vdbcage::view {

/// What users know a family of coordinates by.
const char* titleOf(Coordinates family);
/// What a family does, and its paper.
std::string describe(const FamilyInfo& family);

/// Below the menu: what is done in the picture.
void buildToolbar(const PanelContext& context);
void buildMenu(const PanelContext& context);
/// `typed`, here and below: by the name of a field, what was typed and is not taken over yet.
void buildLayers(const PanelContext& context, std::map<std::string, std::string>& typed);
void buildOptions(const PanelContext& context, std::map<std::string, std::string>& typed);
void buildResult(const PanelContext& context);
/// What is remembered of the time line.
struct TimeLineMemory {
    std::optional<int> last;       ///< the last frame of the track while it is held
    std::optional<int> draggedKey; ///< the frame of a key that is being moved
    float besideKey = 0;           ///< how far to its right the pointer took it, pixels
};
/// Below the picture, in mode pose: playing, the key at this frame, and a track of frames and keys.
void buildTimeLine(const PanelContext& context, std::map<std::string, std::string>& typed, TimeLineMemory& memory);
void buildStatusLine(const PanelContext& context);
/// What lies over the picture, or over two: what is shown and what is being made, axes, scale of the grid, legend.
void buildOverlays(const PanelContext& context, const Rectangle& viewport);
/// Messages, the question before the end, the file browser, help; one at a time. `isHelpOpen` is set back when it is
/// closed.
void buildDialogs(const PanelContext& context, bool& isHelpOpen, FileBrowser& browser);
/// A field for text that is taken over by Enter, Tab, or when another place is clicked; a name, a width in pixels, a
/// hint that is seen while it is empty. Returns what is taken over, if it is another text than `shown`.
std::optional<std::string> typedField(const PanelContext& context, std::map<std::string, std::string>& typed,
                                      const std::string& name, const std::string& shown, float width,
                                      const char* hint = "");
/// The inside of the file browser.
void buildBrowser(const PanelContext& context, FileBrowser& browser);

} // namespace vdbcage::view

#pragma once

#include <map>
#include <optional>
#include <string>

#include <tools/view/panels/context.h>
#include <tools/view/panels/file_browser.h>

/// The parts of the window; each is built once in a layout. Parts with a state get it as a parameter.
namespace vdbcage::view {

/// Returns the name of a family of coordinates for users.
const char* titleOf(Coordinates family);
/// Returns a description of a family and its paper.
std::string describe(const FamilyInfo& family);

/// Builds the toolbar below the menu, for work in the picture.
void buildToolbar(const PanelContext& context);
void buildMenu(const PanelContext& context);
/// `typed`, here and below: texts that were typed and not taken over yet, by the names of their fields.
void buildLayers(const PanelContext& context, std::map<std::string, std::string>& typed);
void buildOptions(const PanelContext& context, std::map<std::string, std::string>& typed);
void buildResult(const PanelContext& context);
/// The state of the time line.
struct TimeLineMemory {
    std::optional<int> last;       ///< the last frame of the track while it is dragged
    std::optional<int> draggedKey; ///< the frame of a key that is being moved
    float besideKey = 0;           ///< distance to its right at which the pointer took it, pixels
};
/// Builds the time line below the picture, in mode pose: playing, the key at this frame, and a track of frames and
/// keys.
void buildTimeLine(const PanelContext& context, std::map<std::string, std::string>& typed, TimeLineMemory& memory);
void buildStatusLine(const PanelContext& context);
/// Builds the overlays of one picture or two: the standing of the made cage and of the model, axes, scale of the grid,
/// legend. `place`: of all pictures.
void buildOverlays(const PanelContext& context, const Rectangle& place);
/// Builds the messages, the question before the end, the file browser and help; one at a time. `isHelpOpen` is set to
/// false when it is closed.
void buildDialogs(const PanelContext& context, bool& isHelpOpen, FileBrowser& browser);
/// Builds a field whose text is taken over by Enter, Tab, or a click elsewhere; with a name, a width in pixels, and a
/// hint that is shown while it is empty. Returns the text taken over, if it differs from `shown`.
std::optional<std::string> typedField(const PanelContext& context, std::map<std::string, std::string>& typed,
                                      const std::string& name, const std::string& shown, float width,
                                      const char* hint = "");
/// Builds the content of the file browser.
void buildBrowser(const PanelContext& context, FileBrowser& browser);

} // namespace vdbcage::view

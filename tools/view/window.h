#pragma once

#include <memory>

#include <tools/view/app.h>
#include <vdbcage/gl/api.h>

namespace vdbcage::view {

/// A window of the desktop with an OpenGL 4.5 core context, which is current on this thread as long as it lives. There
/// is one at a time, on the main thread.
class Window {
public:
    /// \throw DeviceError no display, or no OpenGL 4.5, and the version that there is
    Window(int width, int height);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    const gl::Api& api() const;
    /// Returns its size, scale, clipboard and driver for the App, and a function that wakes run().
    AppSetup setup() const;
    /// Shows the app's picture and passes it the user's events until it has ended. Draws nothing while nothing changes.
    void run(App& app);
    /// Shows the app's picture once, for scripts.
    void show(App& app);

    struct State;

private:
    std::unique_ptr<State> state_;
};

} // namespace vdbcage::view

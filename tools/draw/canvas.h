#pragma once

#include <cstdint>
#include <vector>

#include <tools/draw/renderer.h>
#include <vdbcage/gl/objects.h>

namespace vdbcage::draw {

/// A framebuffer to draw into and to read. Its context must be current in each call, and must outlive it.
class Canvas {
public:
    /// `samples` samples a pixel, 1 or a number that the device has (every one has 4).
    /// \throw DeviceError (too large, out of memory)
    Canvas(const gl::Api& api, int width, int height, int samples);

    /// Returns a target that is the whole canvas, with the line width of `Target`.
    Target target() const;

    /// Returns its pixels, samples averaged: width * height * 4 bytes, row by row from the bottom left; colours are
    /// multiplied by their alpha. \throw DeviceError if anything failed since the canvas was made
    std::vector<std::uint8_t> pixels() const;

private:
    const gl::Api* api_;
    int width_, height_, samples_;
    gl::Texture colour_, depth_, flatColour_;
    gl::Framebuffer drawing_, flat_;
};

} // namespace vdbcage::draw

#pragma once

#include <cstdint>

#include <tools/draw/colour.h>

/// The colours of the window: neutral greys, one accent, and three for messages. Text has the contrast of WCAG 2.1 AA
/// (4.5 to 1) to its background, which test_widgets checks.
namespace vdbcage::view::theme {

/// `code` is 0xRRGGBB.
constexpr draw::Colour colour(std::uint32_t code)
{
    return {static_cast<float>(code >> 16 & 0xFF) / 255.0F, static_cast<float>(code >> 8 & 0xFF) / 255.0F,
            static_cast<float>(code & 0xFF) / 255.0F};
}

// From back to front.
constexpr draw::Colour title = colour(0x202022);
constexpr draw::Colour panel = colour(0x2A2A2C);
constexpr draw::Colour popup = colour(0x303033);
constexpr draw::Colour field = colour(0x1B1B1D), fieldHovered = colour(0x232326), fieldActive = colour(0x272A30);
constexpr draw::Colour button = colour(0x3C3C40), buttonHovered = colour(0x48484D), buttonActive = colour(0x343438);
constexpr draw::Colour line = colour(0x434347); ///< borders and separators
constexpr draw::Colour grip = colour(0x5A5A60); ///< of scroll bars and corners
constexpr draw::Colour gripHovered = colour(0x75757C);

constexpr draw::Colour text = colour(0xECECEE);
constexpr draw::Colour mutedText = colour(0xA8A8AE); ///< labels, units, disabled items

constexpr draw::Colour accent = colour(0x6BA6F7);     ///< marks, handles, active items
constexpr draw::Colour accentFill = colour(0x2A60B4); ///< under `text`
constexpr draw::Colour accentFillHovered = colour(0x3068BE), accentFillActive = colour(0x2657A6);
constexpr draw::Colour selected = colour(0x34476B); ///< under `text`: a row or some letters

constexpr draw::Colour good = colour(0x6CC58B), warning = colour(0xE3B15A), bad = colour(0xF28B82);

} // namespace vdbcage::view::theme

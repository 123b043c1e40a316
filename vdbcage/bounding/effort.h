#pragma once

namespace vdbcage {

/// The time that a cage may take to be tighter.
enum class Effort {
    fast, ///< edges are collapsed, and the cage is tightened once
    fair, ///< edges are split and others collapsed for them too, and the cage is perturbed once
    best  ///< edges are flipped too, and the cage is perturbed several times; decimate() then takes four times as long
};

} // namespace vdbcage

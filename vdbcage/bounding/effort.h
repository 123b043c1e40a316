#pragma once

namespace vdbcage {

/// What a cage may cost in time to be tighter.
enum class Effort { fast, fair, best };

} // namespace vdbcage

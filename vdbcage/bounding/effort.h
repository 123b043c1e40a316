#pragma once

namespace vdbcage {

/// How much time a cage may take to be tighter.
enum class Effort { fast, fair, best };

} // namespace vdbcage

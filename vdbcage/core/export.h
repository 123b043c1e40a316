#pragma once

/// \ingroup core
/// Marks a name as part of the public interface. It stays visible in builds that hide names by default.
#define VDBCAGE_API __attribute__((visibility("default")))

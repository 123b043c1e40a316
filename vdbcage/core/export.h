#pragma once

/// Marks a name as part of the library's public interface, and keeps it visible in builds that hide names by default.
#define VDBCAGE_API __attribute__((visibility("default")))

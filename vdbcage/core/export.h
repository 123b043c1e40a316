#pragma once

/// Marks a name as part of the library's public interface (everything else is hidden in the shared library).
#define VDBCAGE_API __attribute__((visibility("default")))

#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <tools/view/files/preferences.h>
#include <tools/view/jobs/posing.h>
#include <tools/view/state/session.h>

namespace vdbcage::view {

/// What the values that a script can expect are taken from. It must outlive them.
struct ValueSource {
    const Session& session;
    const Planner& planner;
    const Posing& posing;
    const std::vector<std::string>& messages;
    const std::vector<std::string>& notes;
    const std::uint64_t& frames;
    const bool& isEnded;
    const KeyMap& keys;
};

/// All of them, by their names.
std::map<std::string, std::function<std::string()>> valuesOf(const ValueSource& source);

} // namespace vdbcage::view

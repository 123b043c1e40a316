#pragma once

#include <vdbcage/pipeline/detail/stages/candidate.h>
#include <vdbcage/pipeline/detail/stages/certifier.h>

namespace vdbcage::detail {

/// Makes a cage by the operators of the textbook, one after the other. Their result is returned even if it is not valid
/// or not bounding.
/// \throw InputError as Pipeline::run
/// \throw DeviceError
/// \throw Cancelled
Candidate textbookCage(const CageOptions& options, const FieldVersion& scale, Volumes& volumes, Certifier& certifier,
                       std::size_t memoryLimit, Interrupter* interrupter);

} // namespace vdbcage::detail

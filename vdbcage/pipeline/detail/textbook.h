#pragma once

#include <vdbcage/pipeline/detail/candidate.h>
#include <vdbcage/pipeline/detail/certifier.h>

namespace vdbcage::detail {

/// A cage by the operators of the textbook, one after the other. It is as they leave it, valid or not, bounding or not.
/// \throw InputError as Pipeline::run
/// \throw DeviceError
/// \throw Cancelled
Candidate textbookCage(const CageOptions& options, const FieldVersion& scale, Volumes& volumes, Certifier& certifier,
                       std::size_t memoryLimit, Interrupter* interrupter);

/// Quads by merging alone, as the options ask.
Mesh merged(const Mesh& triangles, const CageOptions& options);

} // namespace vdbcage::detail

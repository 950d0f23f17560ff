#pragma once

namespace runnel {

/// FieldInfo::address and ElementOperations::element give a way to change the value; those who only
/// look at it say so by this.
inline void* ForLooking(const void* value) { return const_cast<void*>(value); }

}  // namespace runnel

#pragma once

namespace runnel {

class TypeInfo;

/// Sets `to` to what `from` is, both objects of the type, part by part as the description has it: for values
/// that two libraries share, of which each has its own idea of how the whole is copied. False if a list
/// cannot have that many elements; `to` is then half set. Precondition: the type is transparent.
///
/// Threads: as for the two objects. Allocates.
[[nodiscard]] bool CopyValue(const TypeInfo& type, const void* from, void* to);

}  // namespace runnel

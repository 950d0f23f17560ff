#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "plugins/cdr_values/cdr_stream.h"

namespace runnel {

class TypeInfo;

/// Values of every described type as octets on the wire of ROS 2 ("plain CDR", XCDR1) and back, by their descriptions:
///
///     bool, numbers             as they are, aligned to their size
///     string                    uint32 length with the NUL, characters, NUL
///     duration, time            int32 sec, uint32 nanosec (what does not fit is held at the limit)
///     enumeration               a number as large as the C++ type
///     structure                 its fields in order
///     array, fixed matrix       its elements, row by row
///     vector, optional          uint32 count, elements
///     matrix of any size        uint32 rows, uint32 columns, uint32 count, elements
///     signal, empty structure   one octet 0
///     leaf with its own text    as a string
///
/// Threads: as for the value.

/// Errors: a part of the type is opaque; says which. All other functions want a type that has passed.
[[nodiscard]] Result<void> CheckCdr(const TypeInfo& type);

/// Sets `octets` to header and value. Allocates as far as the vector grows.
void WriteCdr(const TypeInfo& type, const void* value, std::vector<std::byte>& octets);
/// Behind what the writer has written.
void WriteCdr(const TypeInfo& type, const void* value, CdrWriter& writer);

/// Sets `value` from header and value. What follows the value is ignored; fields of the outermost structure that are
/// missing at the end, as earlier versions of a message have it, become as the type makes them.
/// Errors: what is wrong and of which field ("points[2].x"); the value may then be half set. Lists are refused that
/// could not be in so many octets, and what is nested deeper than 100 levels.
/// Large lists of numbers that can (SharedVector) refer to the octets instead of copying them, if these stay as they are as
/// long as anybody has `holder`, are of this machine's order, and are aligned.
/// Allocation: as far as lists and texts grow, in proportion to the octets that are there.
[[nodiscard]] Result<void> ReadCdr(const TypeInfo& type, std::span<const std::byte> octets, void* value,
                                   std::shared_ptr<const void> holder = {});
/// A part of a message: nothing may be missing.
[[nodiscard]] Result<void> ReadCdr(const TypeInfo& type, CdrReader& reader, void* value);

/// The fewest octets that a value takes, without padding: what a list of them can be held against.
[[nodiscard]] std::size_t FewestCdrOctets(const TypeInfo& type);

}  // namespace runnel

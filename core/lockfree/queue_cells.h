#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>

namespace runnel {

/// The cells of a queue. Allocates; errors: std::bad_alloc, also for more cells than can be.
template <typename Cell>
std::unique_ptr<Cell[]> MakeQueueCells(std::size_t capacity) {
  // GCC's operator new for aligned arrays gives nothing at all for sizes past the largest.
  if (capacity > PTRDIFF_MAX / sizeof(Cell)) throw std::bad_array_new_length();
  return std::make_unique<Cell[]>(capacity);
}

}  // namespace runnel

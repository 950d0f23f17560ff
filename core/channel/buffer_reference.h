#pragma once

#include <utility>

#include "core/lockfree/buffer.h"

namespace runnel {

/// One reference to a buffer, for who does not know its type: it keeps the buffer from being reused.
///
/// Threads: one at a time. Allocation: none.
class BufferReference {
 public:
  BufferReference() = default;
  /// Adds one. Precondition: the caller holds the buffer in some way.
  explicit BufferReference(BufferBase<>& buffer) noexcept : buffer_(&buffer) { buffer.AddReferences(1); }
  BufferReference(BufferReference&& other) noexcept : buffer_(std::exchange(other.buffer_, nullptr)) {}
  BufferReference& operator=(BufferReference&&) = delete;
  ~BufferReference() {
    if (buffer_ != nullptr) buffer_->ReleaseReference();
  }

  [[nodiscard]] const BufferBase<>* get() const noexcept { return buffer_; }
  /// The buffer, with the reference, which the caller has to release; nullptr if there is none.
  [[nodiscard]] BufferBase<>* Take() noexcept { return std::exchange(buffer_, nullptr); }

 private:
  BufferBase<>* buffer_ = nullptr;
};

}  // namespace runnel

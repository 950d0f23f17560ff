// Loaded before a program: while the file of RUNNEL_SHORT_MEMORY is there, no thread of it gets memory for 20 ms of each
// 100 ms.

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <new>
#include <thread>

#include <unistd.h>

namespace {

std::atomic<bool> is_short{false};
thread_local constinit bool is_spared = false;

void* Allocate(std::size_t size, std::size_t alignment = 0) noexcept {
  if (is_short.load(std::memory_order_relaxed) && !is_spared) return nullptr;
  if (size == 0) size = 1;
  if (alignment == 0) return std::malloc(size);
  return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

void* Found(void* block) {
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

[[maybe_unused]] const bool has_begun = [] {
  if (const char* const file = std::getenv("RUNNEL_SHORT_MEMORY")) {
    std::thread([file] {
      is_spared = true;
      for (;; std::this_thread::sleep_for(std::chrono::milliseconds(80))) {
        if (access(file, F_OK) != 0) continue;
        is_short = true;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        is_short = false;
      }
    }).detach();
  }
  return true;
}();

}  // namespace

// All others are made of these by the standard library.
void* operator new(std::size_t size) { return Found(Allocate(size)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return Found(Allocate(size, static_cast<std::size_t>(alignment)));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return Allocate(size); }
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }
void operator delete(void* block, std::align_val_t) noexcept { std::free(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { std::free(block); }

#include "tests/support/allocation_guard.h"

#include <cerrno>
#include <cstdlib>

#include "tests/support/sanitizer.h"

namespace {

// Plain words, which need no initialisation and hence no allocation at first use.
thread_local constinit std::size_t allocations = 0;
thread_local constinit std::size_t releases = 0;

}  // namespace

#if !RUNNEL_UNDER_SANITIZER

// glibc's own names for what is replaced below.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* block);

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
  ++allocations;
  return __libc_realloc(block, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  ++allocations;
  *block = __libc_memalign(alignment, size);
  return *block != nullptr ? 0 : ENOMEM;
}
void free(void* block) {
  if (block != nullptr) ++releases;
  __libc_free(block);
}
}

#endif

namespace runnel::test {

AllocationGuard::AllocationGuard() noexcept
    : allocations_before_(::allocations), releases_before_(::releases) {}

bool AllocationGuard::works() noexcept { return !RUNNEL_UNDER_SANITIZER; }

std::size_t AllocationGuard::allocations() const noexcept {
  return ::allocations - allocations_before_;
}
std::size_t AllocationGuard::releases() const noexcept { return ::releases - releases_before_; }

}  // namespace runnel::test

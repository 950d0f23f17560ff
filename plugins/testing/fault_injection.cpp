#include "plugins/testing/fault_injection.h"

#include <cstdlib>
#include <new>
#include <stdexcept>

namespace {

// Plain words, which need no initialisation and hence no allocation at first use.
struct Countdown {
  std::size_t left = 0;  // until it strikes; 0: it does not
  std::size_t further = 0;
  bool has_struck = false;

  bool Strikes() noexcept {
    if (left == 0 || --left > 0) return false;
    if (further > 0) {
      --further;
      left = 1;
    }
    has_struck = true;
    return true;
  }
};
thread_local constinit Countdown allocations;
thread_local constinit Countdown calls;
thread_local constinit bool throws_a_number = false;

void* Allocate(std::size_t size, std::size_t alignment) {
  if (allocations.Strikes()) throw std::bad_alloc();
  if (size == 0) size = 1;
  void* const block = alignment == 0 ? std::malloc(size)
                                     : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

}  // namespace

// All others are made of these by the standard library. A sanitizer's runtime has the forms that do not throw,
// too, and its own blocks must not come to the functions below.
void* operator new(std::size_t size) { return Allocate(size, 0); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return Allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return allocations.Strikes() ? nullptr : std::malloc(size == 0 ? 1 : size);
}
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }
void operator delete(void* block, std::align_val_t) noexcept { std::free(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { std::free(block); }

namespace runnel::test {

FaultInjection::FaultInjection(InjectedFault fault, std::size_t nth, std::size_t further) noexcept {
  allocations = {};
  calls = {};
  throws_a_number = fault == InjectedFault::kNumber;
  (fault == InjectedFault::kAllocation ? allocations : calls) = {.left = nth, .further = further};
}

void FaultInjection::End() noexcept { allocations.left = calls.left = 0; }

bool FaultInjection::has_struck() const noexcept { return allocations.has_struck || calls.has_struck; }

void InjectionPoint() {
  if (!calls.Strikes()) return;
  if (throws_a_number) throw 7;  // what nobody derives from std::exception
  throw std::runtime_error("an injected fault");
}

std::string NameOf(InjectedFault fault) {
  if (fault == InjectedFault::kAllocation) return "failing allocation";
  return fault == InjectedFault::kException ? "throwing call" : "call that throws a number";
}

}  // namespace runnel::test

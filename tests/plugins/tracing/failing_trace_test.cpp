// A program of its own, as it has an operator new of its own, by which one thread's allocations fail.

#include <atomic>
#include <cstdlib>
#include <new>
#include <thread>

#include "tests/plugins/tracing/trace_fixture.h"
#include "tests/support/wait_until.h"

namespace {

const std::thread::id test_thread = std::this_thread::get_id();
std::atomic<bool> fails_elsewhere{false};
std::atomic<bool> has_failed{false};

}  // namespace

[[gnu::noinline]] void* operator new(std::size_t size) {
  if (fails_elsewhere && std::this_thread::get_id() != test_thread) {
    has_failed = true;
    throw std::bad_alloc();
  }
  void* const block = std::malloc(size == 0 ? 1 : size);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}
// A sanitizer's runtime has this form, too, and its own blocks must not come to the functions below.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return fails_elsewhere && std::this_thread::get_id() != test_thread ? nullptr : std::malloc(size == 0 ? 1 : size);
}
[[gnu::noinline]] void operator delete(void* block) noexcept { std::free(block); }
[[gnu::noinline]] void operator delete(void* block, std::size_t) noexcept { std::free(block); }

namespace runnel::test {
namespace {

TEST_F(Traced, EndsWithoutMemoryAndTheApplicationGoesOn) {
  Begin(ClockKind::kSimulated);
  auto& ticker = Make<Ticker>("ticker");
  Ready();
  fails_elsewhere = true;
  WaitUntil("the writing thread needs memory and gets none", [&] {
    (void)scheduler->RunUntil(runtime.clock().Now() + 100ms);
    return has_failed.load();
  });
  const int updates = ticker.updates;
  EXPECT_TRUE(scheduler->RunUntil(runtime.clock().Now() + 1s));
  EXPECT_GT(ticker.updates, updates);
  scheduler->Stop();
  const auto finished = recorder->Finish();
  fails_elsewhere = false;
  ASSERT_FALSE(finished);
  EXPECT_THAT(finished.error().message, ::testing::HasSubstr("came to an early end: std::bad_alloc"));
}

}  // namespace
}  // namespace runnel::test

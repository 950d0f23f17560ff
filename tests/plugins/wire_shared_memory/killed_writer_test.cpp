// Over a real engine, with processes that are killed.

#include <array>
#include <atomic>
#include <csignal>
#include <fstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "plugins/wire_cyclone/cyclone_wire.h"
#include "plugins/wire_shared_memory/shared_memory_wire.h"
#include "tests/plugins/wire_shared_memory/nobody.h"
#include "tests/support/own_network.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

const WireEndpointOptions kTopic = {.topic = "rt/image", .type = "Image"};

// Writes, once somebody writes an octet to `begin`, until it is killed, or who has made it has ended.
[[noreturn]] void WriteForEver(unsigned domain, int begin) {
  char octet = 0;
  (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (read(begin, &octet, 1) != 1) _exit(1);
  Nobody nobody;
  const auto engine = MakeSharedMemoryWire(MakeCycloneWire());
  const auto joined = engine->Join({.domain = domain}, nobody);
  if (!joined) _exit(1);
  const auto writer = (*joined)->MakeWriter(kTopic, {});
  if (!writer) _exit(1);
  for (;;) {
    (void)(*writer)->Write(std::make_shared<Octets>(1'000'000), 1);
    usleep(2000);
  }
}

std::size_t MappedSegments() {
  std::ifstream file("/proc/self/maps");
  std::size_t count = 0;
  for (std::string line; std::getline(file, line);) count += line.find("memfd:runnel values") != std::string::npos;
  return count;
}

TEST(KilledWriterTest, ValuesComeFromTheNextOneAndItsMemoryIsNotKept) {
  const unsigned domain = OwnDomain();
  struct Writer {
    pid_t id;
    int begin;
  };
  std::vector<Writer> writers;  // made before this process has threads
  for (int i = 0; i < 3; ++i) {
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe2(ends.data(), O_CLOEXEC), 0);
    const pid_t writer = fork();
    if (writer == 0) {
      close(ends[1]);
      WriteForEver(domain, ends[0]);
    }
    close(ends[0]);
    writers.push_back({writer, ends[1]});
  }
  Nobody nobody;
  std::atomic<int> shared{0};
  {
    const auto engine = MakeSharedMemoryWire(MakeCycloneWire());
    const auto joined = engine->Join({.domain = domain}, nobody);
    ASSERT_TRUE(joined);
    const auto reader =
        (*joined)->MakeReader(kTopic, [&](const WireSample& sample) { shared += sample.holder != nullptr; }, {});
    ASSERT_TRUE(reader);
    for (const Writer& each : writers) {
      const int before = shared;
      ASSERT_EQ(write(each.begin, "x", 1), 1);
      WaitUntil("values have come", [&] { return shared > before + 10; });
      kill(each.id, SIGKILL);
      waitpid(each.id, nullptr, 0);
      close(each.begin);
    }
    EXPECT_LE(MappedSegments(), 3u);
  }
  EXPECT_EQ(MappedSegments(), 0u);
}

}  // namespace
}  // namespace runnel::test

// Where a component's process listens: what is there already may be anybody's.

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "plugins/genom_standalone/request_server.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

namespace fs = std::filesystem;
using genom_standalone::LineServer;

TEST(LineServerTest, LeavesAFileThatIsNoSocketAlone) {
  const TemporaryFolder folder;
  const fs::path file = folder / "notes";
  std::ofstream(file) << "mine";
  LineServer server;
  EXPECT_FALSE(server.Listen(file.string()));
  std::ifstream left(file);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(left), {}), "mine");
}

TEST(LineServerTest, TakesThePlaceOfOneThatWasKilledAndLetsNobodyElseIn) {
  const TemporaryFolder folder;
  const std::string path = (folder / "socket").string();
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof(address.sun_path) - 1);
  const int left = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  ASSERT_EQ(bind(left, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  close(left);
  LineServer server;
  ASSERT_TRUE(server.Listen(path));
  EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  LineServer second;
  EXPECT_FALSE(second.Listen(path)) << "somebody listens there";
}

}  // namespace
}  // namespace runnel::test

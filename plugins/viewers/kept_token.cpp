#include "plugins/viewers/kept_token.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

#include "plugins/control/control_folder.h"

namespace runnel {

Result<std::unique_ptr<KeptToken>> KeptToken::Write(const std::string& token, std::uint16_t port) {
  const std::filesystem::path folder = ControlFolder();
  if (const auto made = MakeControlFolder(folder); !made) return made.error();
  const std::filesystem::path file = folder / ("inspector-" + std::to_string(port) + ".token");
  unlink(file.c_str());  // of a process that has not ended in order
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  const std::string text = token + "\n";
  const bool is_written =
      descriptor >= 0 && write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  const int reason = errno;
  if (descriptor >= 0) close(descriptor);
  if (is_written) return std::unique_ptr<KeptToken>(new KeptToken(file));
  return Error{.message = std::string("the token cannot be written: ") + std::strerror(reason),
               .position = {file.string()},
               .hint = "give one, in a file: --inspect-token-file=FILE"};
}

KeptToken::~KeptToken() { unlink(file_.c_str()); }

}  // namespace runnel

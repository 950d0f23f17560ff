#pragma once

#include <optional>
#include <string>

#include "plugins/inspector/internal/inspection.h"
#include "plugins/web_server/web_session.h"

namespace runnel::internal {

/// Tells a client each second, and at each press and release, that the application lives and how it stands with the STOP.
///
/// Threads:  the server's.
class LifeSign {
 public:
  LifeSign(Inspection& inspection, WebClient& client);

  /// When it wants the next turn.
  WebSession::SteadyTime Send();

 private:
  Inspection& inspection_;
  WebClient& client_;
  StopSignal::Subscription pressed_;   // gives the session a turn
  std::optional<std::uint64_t> told_;  // of the changes of the STOP
  WebSession::SteadyTime due_{};
};

/// One client over a connection that bears the STOP and nothing else, so that nothing delays it. See PROTOCOL.md.
///
/// Threads:  the server's.
class StopSession final : public WebSession {
 public:
  StopSession(Inspection& inspection, WebClient& client);

  void OnText(std::string_view message) override;
  void OnBinary(std::string_view message) override;
  SteadyTime OnPoll() override;

 private:
  Inspection& inspection_;
  WebClient& client_;
  const std::string name_;
  LifeSign life_;
};

}  // namespace runnel::internal

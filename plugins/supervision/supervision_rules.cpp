#include "plugins/supervision/supervision_rules.h"

#include <variant>

namespace runnel {

namespace {

// Those that reactions are made of.
void MovePathsOf(Change& change, const std::function<void(std::string& path)>& move) {
  const auto move_ends = [&](auto& tie) {
    move(tie.from);
    move(tie.to);
  };
  if (auto* const cut = std::get_if<DisconnectPorts>(&change)) move_ends(*cut);
  if (auto* const tie = std::get_if<ConnectPorts>(&change)) move_ends(*tie);
  if (auto* const set = std::get_if<SetParameter>(&change)) move(set->path);
  if (auto* const replace = std::get_if<ReplaceModule>(&change)) move(replace->path);
}

}  // namespace

void Reaction::MovePaths(const std::function<void(std::string& path)>& move) {
  for (SafeValue& each : published) move(each.port);
  for (std::string& each : released) move(each);
  for (Change& each : changes) MovePathsOf(each, move);
  move(description);
}

}  // namespace runnel

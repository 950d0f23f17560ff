#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "plugins/wire/wire.h"

namespace runnel {

/// What each application tells the others of its structure: its tree as text, latched on "/<name>/runnel_structure", written
/// anew when it has changed. Others' is read once somebody asks for it.
///
/// Threads: Find() any; the rest, and destroying, by one.
class StructureTopic {
 public:
  /// `on_wanted` is called when somebody asks for the first time, by whom.
  static std::unique_ptr<StructureTopic> Start(WireParticipant& participant, const std::string& name,
                                               std::function<void()> on_wanted);
  /// Why nobody is told: what the engine says, as when a permission is missing.
  [[nodiscard]] const std::optional<Error>& refusal() const noexcept { return refusal_; }
  /// Of what tells; nothing if nobody is told.
  [[nodiscard]] std::optional<WireId> id() const { return writer_ ? std::optional(writer_->id()) : std::nullopt; }

  void Tell(const std::string& structure);
  /// Reads what has been asked for. `refused` is told why that of an application cannot be read, each time.
  void Follow(const std::function<void(const std::string& name, const Error& why)>& refused);
  /// That application has gone; one of its name that comes, or is there, is read anew.
  void Forget(const std::string& name);
  /// Of the application of that name; nothing: it has not come yet.
  [[nodiscard]] std::optional<std::string> Find(const std::string& name);

 private:
  explicit StructureTopic(WireParticipant& participant) : participant_(participant) {}

  WireParticipant& participant_;
  std::function<void()> on_wanted_;
  std::string told_;
  std::optional<Error> refusal_;
  std::unique_ptr<WireWriter> writer_;
  std::mutex mutex_;
  std::map<std::string, std::optional<std::string>> texts_;  // that are wanted, by name; guarded by mutex_
  std::map<std::string, std::unique_ptr<WireReader>> readers_;
};

/// The lines of "//base/laser" in what an application has told. Errors: it has no such element, with the nearest name.
[[nodiscard]] Result<std::optional<std::string>> FindInStructure(const std::string& text, const std::string& path);

}  // namespace runnel

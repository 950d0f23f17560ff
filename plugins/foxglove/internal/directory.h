#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/element/configurable.h"
#include "core/element/runtime.h"
#include "core/port/port.h"
#include "plugins/command_service/structure_walk.h"
#include "plugins/values/foxglove_channel.h"

namespace runnel::internal {

/// Elements that clients have brought with them are annotated so: they are not shown to clients.
class BroughtByClient final : public Annotation {};

/// A channel as it is advertised.
struct DirectoryChannel {
  std::uint32_t id;
  std::string topic;
  std::string port;                                 ///< path; "" for the log and the STOP
  const TypeInfo* type;                             ///< nullptr for these
  std::shared_ptr<const FoxgloveChannel> encoding;  ///< of its type, without the topic
};

/// An input that clients may publish to.
struct DirectoryInput {
  std::string path;
  const TypeInfo* type;
  bool drives;  ///< something moves by what comes there
  friend bool operator==(const DirectoryInput&, const DirectoryInput&) = default;
};

struct DirectoryParameter {
  std::string path;
  const TypeInfo* type;
  const Configurable* element;  ///< as long as the structure is the same
};

/// A service as it is advertised. Schemas are "" where there is nothing to say.
struct DirectoryService {
  std::uint32_t id = 0;
  std::string name;
  std::string path = {};
  std::string type = {};  ///< "service Pose2(string)"
  std::string request_schema = {};
  std::string reply_schema = {};
};

/// Who is at the two ends of a topic, by paths.
struct GraphTopic {
  std::vector<std::string> publishers;
  std::vector<std::string> subscribers;
  friend bool operator==(const GraphTopic&, const GraphTopic&) = default;
};

/// What there is in an application at one moment, by the names that clients know.
struct DirectoryContent {
  std::map<std::uint32_t, DirectoryChannel> channels;
  /// By path, and by topic where that means one only.
  std::map<std::string, DirectoryInput, std::less<>> inputs;
  std::map<std::string, DirectoryParameter, std::less<>> parameters;
  std::map<std::string, GraphTopic> graph;
  std::map<std::uint32_t, DirectoryService> services;
};

/// Keeps what clients can ask for in step with the structure, for all of them together.
///
/// Threads:  the server's. Waits for no lock.
class Directory {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  explicit Directory(Runtime& runtime);
  ~Directory();

  /// Looks whether the structure has changed, unless that has just been done or somebody has it
  /// locked. When it is to be called again.
  SteadyTime Look(SteadyTime now);
  /// Never nullptr; another object whenever something has changed.
  [[nodiscard]] std::shared_ptr<const DirectoryContent> content() const { return content_; }

  /// Shows the parameters one by one, each with the index of its name; nullptr if there is none. False, and
  /// none is shown, if that cannot be done at the moment: the structure is locked, or has just changed.
  using ParameterVisitor = std::function<void(std::size_t index, const DirectoryParameter*)>;
  bool VisitParameters(const std::vector<std::string>& names, const ParameterVisitor& visit) const;

 private:
  using Encoding = std::shared_ptr<const FoxgloveChannel>;
  struct Encodings {
    std::vector<Encoding> plain;  // under the topic of the port
    Encoding transform;           // nullptr: the type's values are no poses
  };

  struct Search;

  void AddChannels(const Search& search, const Port* robot_pose, DirectoryContent& content);
  void AddChannel(std::string topic, const std::string& port, const TypeInfo* type, const Encoding& encoding,
                  DirectoryContent& content);
  [[nodiscard]] const Encodings& EncodingsOf(const TypeInfo& type);

  Runtime& runtime_;
  StructureWalk walk_;
  std::unique_ptr<Search> search_;  // while the walk is under way
  SteadyTime look_at_{};
  std::shared_ptr<const DirectoryContent> content_ = std::make_shared<DirectoryContent>();
  const Encoding stop_;
  const Encoding log_ = std::make_shared<const FoxgloveChannel>(LogChannel());
  std::unordered_map<const TypeInfo*, Encodings> encodings_;
  // Numbers that have been given: a topic that comes back in the same form has its old one.
  std::map<std::pair<std::string, const FoxgloveChannel*>, std::uint32_t> ids_;
  std::map<std::string, std::uint32_t> service_ids_;  // by all that is said of them
};

}  // namespace runnel::internal

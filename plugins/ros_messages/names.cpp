#include "plugins/ros_messages/names.h"

#include <algorithm>

#include "core/base/characters.h"

namespace runnel {

namespace {

constexpr std::size_t kLongest = 247;
constexpr std::string_view kTopic = "rt", kRequest = "rq", kReply = "rr";

bool IsLower(char c) { return c >= 'a' && c <= 'z'; }
bool IsUpper(char c) { return c >= 'A' && c <= 'Z'; }
bool IsDigit(char c) { return c >= '0' && c <= '9'; }
bool IsLetter(char c) { return IsLower(c) || IsUpper(c); }
bool IsWord(char c) { return IsLetter(c) || IsDigit(c) || c == '_'; }

std::string WhyNoRosName(std::string_view name) {
  if (name.size() < 2 || name.front() != '/') return "begins with '/' and a word";
  if (name.size() > kLongest) return "has at most " + std::to_string(kLongest) + " characters";
  if (name.ends_with('/') || name.find("//") != std::string_view::npos) {
    return "has a word behind each '/'";
  }
  for (std::size_t i = 1; i < name.size(); ++i) {
    if (!IsWord(name[i]) && name[i] != '/') return "has letters of ASCII, digits, '_' and '/' only";
    if (IsDigit(name[i]) && name[i - 1] == '/') return "has no word that begins with a digit";
  }
  return "";
}

}  // namespace

Result<void> CheckRosName(std::string_view name) {
  const std::string why_not = WhyNoRosName(name);
  if (why_not.empty()) return {};
  return Error{.message = "a name of ROS 2 " + why_not + ", unlike " + Quoted(name),
               .hint = "write '" + NearestRosName(name) + "'"};
}

std::string NearestRosName(std::string_view name) {
  std::string nearest;
  for (const char c : name) {
    const bool begins = nearest.empty() || nearest.back() == '/';
    if (c == '/') {
      if (!begins || nearest.empty()) nearest += '/';
      continue;
    }
    if (nearest.empty()) nearest += '/';
    if (nearest.back() == '/' && IsDigit(c)) nearest += '_';
    nearest += IsWord(c) ? c : '_';
  }
  nearest.resize(std::min(nearest.size(), kLongest));
  while (nearest.ends_with('/')) nearest.pop_back();
  return nearest.empty() ? "/topic" : nearest;
}

std::string DdsTopic(std::string_view topic) { return std::string(kTopic).append(topic); }
std::string DdsRequestTopic(std::string_view service) { return std::string(kRequest).append(service) + "Request"; }
std::string DdsReplyTopic(std::string_view service) { return std::string(kReply).append(service) + "Reply"; }
std::string RosTopic(std::string_view dds_topic) {
  if (!dds_topic.starts_with(kTopic) || !CheckRosName(dds_topic.substr(kTopic.size()))) return "";
  return std::string(dds_topic.substr(kTopic.size()));
}

std::string DdsType(std::string_view ros_type) {
  const std::size_t last = ros_type.rfind('/');
  std::string type;
  for (const char c : ros_type.substr(0, last)) type += c == '/' ? "::" : std::string(1, c);
  return type + "::dds_::" + std::string(ros_type.substr(last + 1)) + "_";
}

std::string RosType(std::string_view dds_type) {
  constexpr std::string_view kMark = "::dds_::";
  const std::size_t mark = dds_type.find(kMark);
  if (mark == std::string_view::npos || !dds_type.ends_with('_')) return "";
  std::string type(dds_type.substr(0, mark));
  const std::size_t colons = type.find("::");
  if (colons == std::string::npos) return "";
  type.replace(colons, 2, "/");
  const std::string_view name = dds_type.substr(mark + kMark.size());
  return type + "/" + std::string(name.substr(0, name.size() - 1));
}

std::string PackageOf(std::string_view ros_type) { return std::string(ros_type.substr(0, ros_type.find('/'))); }
std::string LastNameOf(std::string_view ros_type) { return std::string(ros_type.substr(ros_type.rfind('/') + 1)); }

bool IsRosPackageName(std::string_view name) { return name.size() > 1 && IsSnakeCase(name); }
bool IsRosFieldName(std::string_view name) { return IsSnakeCase(name); }
bool IsRosMessageName(std::string_view name) {
  return !name.empty() && IsUpper(name.front()) &&
         std::ranges::all_of(name, [](char c) { return IsLetter(c) || IsDigit(c); });
}

static std::string Nearest(const std::string& name, const char* instead, const char* before_digit) {
  if (name.empty()) return instead;
  return (IsDigit(name.front()) ? before_digit : "") + name;
}
std::string NearestMessageName(std::string_view name) { return Nearest(CamelCase(name), "Value", "T"); }
std::string NearestFieldName(std::string_view name) { return Nearest(SnakeCase(name), "value", "f"); }

}  // namespace runnel

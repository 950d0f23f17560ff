#include "plugins/wire_shared_memory/neighbours.h"

#include <algorithm>
#include <fstream>
#include <string_view>

#include <sys/stat.h>
#include <unistd.h>

namespace runnel {

namespace {

constexpr std::string_view kKey = "shared_memory=";
constexpr const char* kLayout = "/2";  // of what is shared: others are sent octets

}  // namespace

std::string MemoryOfThisProcess() {
  std::string started;
  std::getline(std::ifstream("/proc/sys/kernel/random/boot_id") >> std::ws, started);
  struct stat network {};
  // Without either, alone.
  if (started.empty() || stat("/proc/self/ns/net", &network) != 0) started = std::to_string(getpid());
  const std::string text = started + '/' + std::to_string(network.st_ino) + '/' + std::to_string(geteuid()) + kLayout;
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a: others need not know the parts
  for (const char each : text) hash = (hash ^ static_cast<unsigned char>(each)) * 0x100000001b3;
  std::string said(kKey);
  for (int shift = 60; shift >= 0; shift -= 4) said += "0123456789abcdef"[hash >> shift & 15];
  return said + ';';
}

std::string WithoutMemory(std::string user_data) {
  const std::size_t begin = user_data.find(kKey);
  if (begin != std::string::npos) user_data.erase(begin, user_data.find(';', begin) - begin + 1);
  return user_data;
}

void Neighbours::Add(const WireMember& member) {
  const std::lock_guard lock(mutex_);
  if (member.user_data.find(memory_) != std::string::npos) {
    sharing_.insert(member.id);
  } else {
    sharing_.erase(member.id);
  }
}

void Neighbours::RemoveMember(const WireId& id) {
  const std::lock_guard lock(mutex_);
  sharing_.erase(id);
}

void Neighbours::Add(const WireEndpoint& endpoint) {
  const std::lock_guard lock(mutex_);
  if (!endpoint.is_own) endpoints_[endpoint.id] = endpoint;
}

void Neighbours::RemoveEndpoint(const WireId& id) {
  const std::lock_guard lock(mutex_);
  endpoints_.erase(id);
}

bool Neighbours::AllShare(const std::string& topic, std::size_t matched) const {
  const std::lock_guard lock(mutex_);
  std::size_t count = 0;
  for (const auto& [id, each] : endpoints_) {
    if (each.is_writer || each.options.topic != topic) continue;
    if (!sharing_.contains(each.participant)) return false;
    ++count;
  }
  return count > 0 && count >= matched;
}

bool Neighbours::IsThere(std::uint64_t writer) const {
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(endpoints_, [&](const auto& each) { return each.second.is_writer && each.second.handle == writer; });
}

}  // namespace runnel

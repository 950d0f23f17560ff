#include "core/plugin/plugin_manager.h"

#include <cstdlib>
#include <cstring>
#include <set>

#include <dlfcn.h>

#include "core/base/characters.h"
#include "core/base/files.h"
#include "core/base/nearest_name.h"
#include "core/element/attempt.h"
#include "core/plugin/abi_difference.h"
#include "core/plugin/plugin_entry.h"

namespace runnel {

namespace {

namespace fs = std::filesystem;

// The folder that holds the core's own library.
fs::path CoreFolder() {
  Dl_info info;
  if (dladdr(reinterpret_cast<const void*>(&CoreAbiFingerprint), &info) == 0) return {};
  return fs::absolute(info.dli_fname).parent_path();
}

Error Refusal(const fs::path& file, std::string why, std::string hint = {}) {
  return {.message = "the plugin " + file.string() + " is refused: " + std::move(why), .hint = std::move(hint)};
}

// It is never unmapped: types, vtables and strings of it may live on in objects that nobody can count.
Result<void*> OpenLibrary(const fs::path& file) {
  if (const auto whole = CheckIsWhole(file); !whole) return Refusal(file, whole.error().message, whole.error().hint);
  // NOW: a missing symbol is an error here, not a crash later. LOCAL: plugins do not see each other.
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (library != nullptr) return library;
  const char* const reason = dlerror();
  return Error{.message =
                   "cannot load the library " + file.string() + ": " + (reason != nullptr ? reason : "unknown reason")};
}

// Reads only what never changes its place before it trusts the rest.
Result<const PluginEntry*> Handshake(void* library, const fs::path& file) {
  const auto entry_function = reinterpret_cast<const PluginEntry* (*)()>(dlsym(library, kPluginEntrySymbol));
  if (entry_function == nullptr) {
    return Refusal(file, std::string("it has no entry ") + kPluginEntrySymbol,
                   "write RUNNEL_PLUGIN(name, registry) { … } in one of its sources");
  }
  const PluginEntry* const entry = entry_function();
  if (entry == nullptr) return Refusal(file, "its entry is empty");
  if (entry->abi_version != kPluginAbiVersion) {
    return Refusal(file,
                   "it was built for plugin ABI " + std::to_string(entry->abi_version) + ", this core has " +
                       std::to_string(kPluginAbiVersion),
                   "rebuild the plugin");
  }
  if (entry->entry_size != sizeof(PluginEntry)) {
    return Refusal(file, "its entry has another size than this core's", "rebuild the plugin");
  }
  if (std::strcmp(entry->fingerprint, CoreAbiFingerprint()) != 0) {
    AbiDifference difference = FindAbiDifference(entry->fingerprint, CoreAbiFingerprint());
    return Refusal(file, std::move(difference.why), std::move(difference.cure));
  }
  return entry;
}

}  // namespace

const char* CoreAbiFingerprint() noexcept { return kAbiFingerprint; }

PluginManager::PluginManager() {
  const char* const variable = std::getenv("RUNNEL_PLUGIN_PATH");
  for (const auto folder : PartsBetween(":", variable != nullptr ? variable : "")) search_path_.emplace_back(folder);
  search_path_.push_back(CoreFolder() / RUNNEL_PLUGIN_FOLDER);
}

void PluginManager::AddSearchFolder(fs::path folder) { search_path_.insert(search_path_.begin(), std::move(folder)); }

Result<void> PluginManager::Load(std::string_view name) {
  return Attempt([&] { return LoadUnlessKnown(name); }, "the plugin '", name, "' cannot be loaded: ");
}

Result<void> PluginManager::LoadUnlessKnown(std::string_view name) {
  const auto file = FindFile(name);
  if (!file) return file.error();
  const std::string plugin = file->stem().string();
  std::error_code ignored;
  const fs::path canonical = fs::weakly_canonical(*file, ignored);
  const auto known = files_.find(plugin);
  if (known == files_.end()) {
    // All memory comes before the plugin's own code.
    Files of_it;
    of_it.emplace(plugin, canonical);
    loaded_.reserve(loaded_.size() + 1);
    std::string own_name = plugin;
    auto registered = Register(plugin, *file);
    if (!registered) return registered;
    files_.merge(of_it);
    loaded_.push_back(std::move(own_name));
    return {};
  }
  if (known->second == canonical) return {};
  return Refusal(*file, "a plugin '" + plugin + "' is loaded already from " + known->second.string(),
                 "rename one of the two");
}

Result<void> PluginManager::Register(const std::string& name, const fs::path& file) {
  const auto library = OpenLibrary(file);
  if (!library) return library.error();
  const auto entry = Handshake(*library, file);
  if (!entry) return entry.error();
  struct Reset {  // whatever comes of it: what others add later is not this plugin's
    ~Reset() { registry.set_plugin(""); }
    PluginRegistry& registry;
  } const reset{registry_};
  registry_.set_plugin(name);
  const auto refused = [&](std::string why) {
    Retry([&] { (void)registry_.SetAside(name); });
    return Refusal(file, std::move(why));
  };
  try {
    (*entry)->register_plugin(registry_);
  } catch (...) {
    return refused(CaughtError("its registration failed: ").message);
  }
  return {};
}

void PluginManager::OpenAhead(const fs::path& file) { (void)OpenLibrary(file); }

Result<TemporaryCopy> PluginManager::OpenCopy(const fs::path& file) {
  auto copy = TemporaryCopy::Make(file);
  if (!copy) return copy;
  if (const auto outdated = FindOutdatedDependency(copy->file())) {
    return Refusal(file, "it needs " + outdated->string() + ", which has been built anew, too",
                   "start the application again, or link that library into the plugin (STATIC)");
  }
  OpenAhead(copy->file());
  return copy;
}

Result<PluginReload> PluginManager::Reload(std::string_view name) {
  const auto file = FindKnown(name);
  if (!file) return file.error();
  const auto copy = OpenCopy(*file);
  if (!copy) return copy.error();
  return Reload(name, *copy);
}

Result<PluginReload> PluginManager::Reload(std::string_view name, const TemporaryCopy& copy) {
  return Attempt([&] { return ReloadKnown(name, copy); }, "the plugin '", name, "' cannot be loaded anew: ");
}

Result<fs::path> PluginManager::FindKnown(std::string_view name) const {
  const auto known = files_.find(name);
  if (known != files_.end()) return known->second;
  return Error{.message = "no plugin '" + std::string(name) + "' is loaded", .hint = NearestNameHint(name, loaded_)};
}

Result<PluginReload> PluginManager::ReloadKnown(std::string_view name, const TemporaryCopy& copy) {
  const auto known = FindKnown(name);
  if (!known) return known.error();
  const std::string plugin(name);
  std::string told = plugin;  // all memory comes before what is there is taken out
  PluginReload reload(registry_, std::move(told), registry_.SetAside(plugin));
  auto registered = Register(plugin, copy.file());
  if (!registered) {
    Error error = registered.error();
    // The copy is nobody's business.
    const std::string own = copy.file().string();
    if (const auto at = error.message.find(own); at != std::string::npos) {
      error.message.replace(at, own.size(), known->string());
    }
    return error;
  }
  return reload;
}

Result<fs::path> PluginManager::FindFile(std::string_view name) const {
  std::error_code ignored;
  if (const auto known = files_.find(name); known != files_.end()) return known->second;
  if (name.find('/') != std::string_view::npos) {
    if (fs::exists(name, ignored)) return fs::path(name);
    return Error{.message = "there is no plugin file '" + std::string(name) + "'"};
  }
  std::string folders;
  for (const fs::path& folder : search_path_) {
    fs::path file = folder / (std::string(name) + ".so");
    if (fs::exists(file, ignored)) return file;
    folders += (folders.empty() ? "" : ", ") + folder.string();
  }
  const std::string nearest = NearestNameHint(name, Available());
  return Error{.message = "no plugin '" + std::string(name) + "' in " + folders,
               .hint = nearest + (nearest.empty() ? "" : "; ") +
                       "one of your own is found by RUNNEL_PLUGIN_PATH=FOLDER, or installed beside these"};
}

std::vector<std::string> PluginManager::Available() const {
  std::set<std::string> names;
  std::error_code ignored;
  for (const fs::path& folder : search_path_) {
    for (const fs::path name : NamesInFolder(folder)) {
      const bool is_library = name.extension() == ".so" && fs::is_regular_file(folder / name, ignored);
      if (is_library) names.insert(name.stem().string());
    }
  }
  return {names.begin(), names.end()};
}

}  // namespace runnel

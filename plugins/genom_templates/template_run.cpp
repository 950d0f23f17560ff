#include "plugins/genom_templates/template_run.h"

#include <charconv>
#include <cstdlib>
#include <memory>
#include <optional>

#include <lua.hpp>
#include <nlohmann/json.hpp>

#include "core/base/files.h"

namespace runnel::genom {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
constexpr const char* kStrict = "runnel.strict";

int TellMissingField(lua_State* lua) {
  return luaL_error(lua, "there is no field '%s' here", luaL_tolstring(lua, 2, nullptr));
}

void MakeStrict(lua_State* lua) {
  if (luaL_newmetatable(lua, kStrict) != 0) {
    lua_pushcfunction(lua, TellMissingField);
    lua_setfield(lua, -2, "__index");
  }
  lua_setmetatable(lua, -2);
}

// Nothing with a destructor lives here: Lua's errors jump.
void Push(lua_State* lua, const Json& json) {
  luaL_checkstack(lua, 4, "the description is nested too deeply");
  switch (json.type()) {
    case Json::value_t::object:
      lua_createtable(lua, 0, static_cast<int>(json.size()));
      for (auto each = json.begin(); each != json.end(); ++each) {
        lua_pushlstring(lua, each.key().data(), each.key().size());
        Push(lua, *each);
        lua_rawset(lua, -3);
      }
      MakeStrict(lua);
      break;
    case Json::value_t::array: {
      lua_createtable(lua, static_cast<int>(json.size()), 0);
      lua_Integer index = 0;
      for (const Json& each : json) {
        Push(lua, each);
        lua_rawseti(lua, -2, ++index);
      }
      break;
    }
    case Json::value_t::string: {
      const std::string& text = json.get_ref<const std::string&>();
      lua_pushlstring(lua, text.data(), text.size());
      break;
    }
    case Json::value_t::boolean:
      lua_pushboolean(lua, json.get<bool>() ? 1 : 0);
      break;
    case Json::value_t::number_integer:
    case Json::value_t::number_unsigned:
      lua_pushinteger(lua, json.get<lua_Integer>());
      break;
    case Json::value_t::number_float:
      lua_pushnumber(lua, json.get<lua_Number>());
      break;
    default:
      lua_pushboolean(lua, 0);
  }
}

// A description as tables: null is false, and a field that is not there is an error. False if the text is no JSON.
bool PushModel(lua_State* lua, const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return false;
  Push(lua, json);
  return true;
}

// Texts by their names, strict in the same way.
void PushTexts(lua_State* lua, const std::map<std::string, std::string>& texts) {
  lua_createtable(lua, 0, static_cast<int>(texts.size()));
  for (const auto& [name, text] : texts) {
    lua_pushlstring(lua, text.data(), text.size());
    lua_setfield(lua, -2, name.c_str());
  }
  MakeStrict(lua);
}

// What templates call, as far as Lua itself can do it. Chunks are named "#N", N being the file's number.
constexpr const char* kPrelude = R"lua(
local host_source, host_add = ...
local outputs, libraries = {}, {}

function write(...)
  local output = outputs[#outputs]
  if not output then error("only the texts of a template are written to", 2) end
  for i = 1, select("#", ...) do
    local value = select(i, ...)
    if value == nil then error("what is to be written has no value", 2) end
    output[#output + 1] = tostring(value)
  end
end
write_text = write
function write_value(value)
  if value == nil then error("what is to be written has no value", 2) end
  local output = outputs[#outputs]
  output[#output + 1] = tostring(value)
end

local function run(name, is_text, environment)
  local program, chunk = host_source(name, is_text)
  if not program then error(chunk) end
  local loaded, message = load(program, chunk, "t", environment)
  if not loaded then error(message, 0) end
  return loaded
end

function text(source, variables)
  local environment = setmetatable({}, {__index = _G})
  for name, value in pairs(variables or {}) do environment[name] = value end
  outputs[#outputs + 1] = {}
  run(source, true, environment)()
  return table.concat(table.remove(outputs))
end
function file(source, destination, variables) host_add(destination, text(source, variables), false) end
function keep(source, destination, variables) host_add(destination, text(source, variables), true) end
function library(name)
  if not libraries[name] then libraries[name] = run(name .. ".lua", false, _G)() end
  return libraries[name]
end
function has(table, field) return rawget(table, field) ~= nil end
function fail(message) error(setmetatable({}, {__tostring = function() return tostring(message) end})) end

setmetatable(_G, {__index = function(_, name) error("there is no '" .. tostring(name) .. "' here", 2) end})
run("template.lua", false, _G)()
)lua";

class Run {
 public:
  Run(fs::path folder, const TemplateLimits& limits)
      : folder_(std::move(folder)), limits_(limits), lua_(lua_newstate(Allocate, this), lua_close) {}

  Result<TemplateOutput> Go(const std::string& model, const std::map<std::string, std::string>& options) {
    if (!lua_) return Error{.message = "there is no memory for the template"};
    lua_State* lua = lua_.get();
    luaL_openlibs(lua);
    if (!PushModel(lua, model)) return Error{.message = "the description is no JSON"};
    lua_setglobal(lua, "model");
    PushTexts(lua, options);
    lua_setglobal(lua, "options");
    *static_cast<Run**>(lua_getextraspace(lua)) = this;
    lua_sethook(lua, CountSteps, LUA_MASKCOUNT, kStepsAtOnce);
    lua_pushcfunction(lua, AddPlace);
    if (luaL_loadbuffer(lua, kPrelude, std::char_traits<char>::length(kPrelude), "=runnel") == LUA_OK) {
      lua_pushlightuserdata(lua, this);
      lua_pushcclosure(lua, Source, 1);
      lua_pushlightuserdata(lua, this);
      lua_pushcclosure(lua, Add, 1);
      is_limited_ = true;
      const int status = lua_pcall(lua, 2, 0, -4);
      is_limited_ = false;
      if (status == LUA_OK) return std::move(output_);
      if (status == LUA_ERRMEM) return TooMuch("memory");
    }
    const char* message = luaL_tolstring(lua, -1, nullptr);
    return ErrorOf(message == nullptr ? "" : message);
  }

 private:
  static constexpr int kStepsAtOnce = 10'000;
  static constexpr std::uint64_t kMostOften = 64;  // so many times the memory in all

  [[nodiscard]] Error TooMuch(const std::string& what) const {
    return {.message = "the template needs too much " + what,
            .position = {output_.sources.empty() ? "" : output_.sources.back(), 0}};
  }

  static void* Allocate(void* context, void* before, std::size_t size_before, std::size_t size) {
    Run& self = *static_cast<Run*>(context);
    if (before == nullptr) size_before = 0;  // it says what is to be made, then
    if (self.is_limited_ && size > size_before) {
      // What is made and thrown away counts, too: a text that grows bit by bit takes few steps, and for ever.
      self.bytes_made_ += size;
      const bool is_too_much = self.bytes_made_ / kMostOften > self.limits_.bytes;
      if (is_too_much || self.bytes_ + (size - size_before) > self.limits_.bytes) return nullptr;
    }
    if (size == 0) {
      std::free(before);
    } else if (void* const after = std::realloc(before, size); after != nullptr) {
      before = after;
    } else {
      return nullptr;
    }
    self.bytes_ += size - size_before;  // wraps around where it is less
    return size == 0 ? nullptr : before;
  }

  static void CountSteps(lua_State* lua, lua_Debug* /*at*/) {
    Run& self = **static_cast<Run**>(lua_getextraspace(lua));
    self.steps_ += kStepsAtOnce;
    if (self.steps_ <= self.limits_.steps) return;
    luaL_where(lua, 0);
    lua_pushliteral(lua, "the template does not come to an end");
    lua_concat(lua, 2);
    lua_error(lua);
  }

  // Errors of what is called get the place in the template from where it is.
  static int AddPlace(lua_State* lua) {
    if (lua_type(lua, 1) != LUA_TSTRING) return 1;
    std::string_view message = lua_tostring(lua, 1);
    if (message.starts_with('#')) return 1;
    constexpr std::string_view kOfPrelude = "runnel:";
    if (message.starts_with(kOfPrelude)) {
      const std::size_t end = message.find(": ");
      if (end != std::string_view::npos) message.remove_prefix(end + 2);
    }
    lua_Debug at{};
    for (int level = 1; lua_getstack(lua, level, &at) != 0; ++level) {
      lua_getinfo(lua, "Sl", &at);
      if (std::string_view(at.source).starts_with("@#") && at.currentline > 0) {
        lua_pushfstring(lua, "%s:%d: %s", at.short_src, at.currentline, message.data());
        return 1;
      }
    }
    lua_pushlstring(lua, message.data(), message.size());
    return 1;
  }

  static Run& Self(lua_State* lua) { return *static_cast<Run*>(lua_touserdata(lua, lua_upvalueindex(1))); }

  // source(name, is_text) gives the program and the name of its chunk, or false and why not. What has a destructor ends
  // before Lua may jump.
  static int Source(lua_State* lua) {
    Run& self = Self(lua);
    const char* name = luaL_checkstring(lua, 1);
    const bool is_right = self.Read(name, lua_toboolean(lua, 2) != 0);
    if (is_right) {
      lua_pushlstring(lua, self.program_.data(), self.program_.size());
    } else {
      lua_pushboolean(lua, 0);
    }
    lua_pushlstring(lua, self.answer_.data(), self.answer_.size());
    return 2;
  }

  static int Add(lua_State* lua) {
    Run& self = Self(lua);
    const char* path = luaL_checkstring(lua, 1);
    std::size_t length = 0;
    const char* text = luaL_checklstring(lua, 2, &length);
    self.output_.files.push_back({path, {text, length}, lua_toboolean(lua, 3) != 0});
    return 0;
  }

  // Leaves the program and its name, or the message, behind.
  bool Read(const std::string& name, bool is_text) {
    // Its own files, then those that all templates share.
    fs::path file = folder_ / name;
    auto found = TextOfFile(file);
    if (!found) {
      file = folder_.parent_path() / "library" / name;
      found = TextOfFile(file);
    }
    if (!found) {
      answer_ = "there is no file '" + name + "' in the template";
      return false;
    }
    output_.sources.push_back(file.string());
    answer_ = "@#" + std::to_string(output_.sources.size());
    if (!is_text) {
      program_ = std::move(*found);
      return true;
    }
    auto program = ProgramOf(*found);
    if (program) {
      program_ = std::move(*program);
      return true;
    }
    wrong_text_ = program.error();
    wrong_text_->position.file = file.string();
    answer_ = wrong_text_->message;
    return false;
  }

  [[nodiscard]] std::string FileOfChunk(std::string_view number) const {
    std::size_t index = 0;
    const auto read = std::from_chars(number.data(), number.data() + number.size(), index);
    const bool is_one = read.ec == std::errc() && index >= 1 && index <= output_.sources.size();
    return is_one ? output_.sources[index - 1] : "";
  }

  // "#2:14: message" is line 14 of the second file.
  [[nodiscard]] Error ErrorOf(const std::string& message) const {
    if (wrong_text_) return *wrong_text_;
    Error error{.message = message};
    const std::size_t first = message.find(':');
    const std::size_t second = first == std::string::npos ? first : message.find(':', first + 1);
    if (second == std::string::npos || !message.starts_with('#')) return error;
    const std::string file = FileOfChunk(std::string_view(message).substr(1, first - 1));
    if (file.empty()) return error;
    int line = 0;
    std::from_chars(message.data() + first + 1, message.data() + second, line);
    error.position = {file, line};
    error.message = message.substr(std::min(second + 2, message.size()));
    return error;
  }

  fs::path folder_;
  const TemplateLimits limits_;
  std::size_t bytes_ = 0;
  std::uint64_t bytes_made_ = 0;
  bool is_limited_ = false;  // only while errors are caught
  std::uint64_t steps_ = 0;
  std::unique_ptr<lua_State, decltype(&lua_close)> lua_;
  TemplateOutput output_ = {};
  std::string program_ = {};
  std::string answer_ = {};
  std::optional<Error> wrong_text_ = {};
};

}  // namespace

Result<TemplateOutput> RunTemplate(const fs::path& folder, const std::string& model,
                                   const std::map<std::string, std::string>& options, const TemplateLimits& limits) {
  const fs::path whole = fs::absolute(folder).lexically_normal();
  return Run(whole.filename().empty() ? whole.parent_path() : whole, limits).Go(model, options);
}

}  // namespace runnel::genom

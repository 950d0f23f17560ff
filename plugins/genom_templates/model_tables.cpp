#include "plugins/genom_templates/model_tables.h"

#include <lua.hpp>
#include <nlohmann/json.hpp>

namespace runnel::genom {

namespace {

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
    case Json::value_t::boolean: lua_pushboolean(lua, json.get<bool>() ? 1 : 0); break;
    case Json::value_t::number_integer:
    case Json::value_t::number_unsigned: lua_pushinteger(lua, json.get<lua_Integer>()); break;
    case Json::value_t::number_float: lua_pushnumber(lua, json.get<lua_Number>()); break;
    default: lua_pushboolean(lua, 0);
  }
}

}  // namespace

bool PushModel(lua_State* lua, const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return false;
  Push(lua, json);
  return true;
}

void PushTexts(lua_State* lua, const std::map<std::string, std::string>& texts) {
  lua_createtable(lua, 0, static_cast<int>(texts.size()));
  for (const auto& [name, text] : texts) {
    lua_pushlstring(lua, text.data(), text.size());
    lua_setfield(lua, -2, name.c_str());
  }
  MakeStrict(lua);
}

}  // namespace runnel::genom

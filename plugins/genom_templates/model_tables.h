#pragma once

#include <map>
#include <string>

struct lua_State;

namespace runnel::genom {

/// Pushes a description as tables: null is false, and a field that is not there is an error. False if the text is no JSON.
bool PushModel(lua_State* lua, const std::string& json);

/// Pushes texts by their names, strict in the same way.
void PushTexts(lua_State* lua, const std::map<std::string, std::string>& texts);

}  // namespace runnel::genom

-- How things look to people.

local show = {}

function show.type(type)
  if has(type, "name") then return type.name end
  local length = has(type, "length") and tostring(type.length) or nil
  if type.kind == "array" then return show.type(type.type) .. "[" .. length .. "]" end
  if type.kind == "string" then return length and "string<" .. length .. ">" or "string" end
  if has(type, "type") then return type.kind .. "<" .. show.type(type.type) .. (length and ", " .. length or "") .. ">" end
  return type.kind
end

-- A text within a cell of a table.
function show.cell(text) return (text:gsub("\n", " "):gsub("|", "\\|")) end

local function value(initial)
  if has(initial, "parts") then
    local parts = {}
    for _, part in ipairs(initial.parts) do
      local name = has(part, "member") and part.member .. ": " or has(part, "index") and "[" .. part.index .. "]: " or ""
      local inner = value(part)
      if inner ~= "" then parts[#parts + 1] = name .. inner end
    end
    return "{" .. table.concat(parts, ", ") .. "}"
  end
  return has(initial, "value") and tostring(initial.value) or ""
end

function show.default(parameter)
  if not has(parameter, "default") then return "" end
  local text = value(parameter.default)
  return text ~= "" and text ~= "{}" and "`" .. show.cell(text) .. "`" or ""
end

-- The documentation of a parameter, and of its members.
function show.doc(parameter)
  if not has(parameter, "default") then return "" end
  local texts = {}
  local function collect(initial, path)
    if has(initial, "doc") then texts[#texts + 1] = (path ~= "" and path .. ": " or "") .. initial.doc end
    if not has(initial, "parts") then return end
    for _, part in ipairs(initial.parts) do
      local name = has(part, "member") and part.member or "[" .. part.index .. "]"
      collect(part, path ~= "" and path .. "." .. name or name)
    end
  end
  collect(parameter.default, "")
  return show.cell(table.concat(texts, "; "))
end

return show

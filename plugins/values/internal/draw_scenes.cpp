#include <algorithm>
#include <string_view>
#include <vector>

#include "core/types/type_of.h"
#include "plugins/values/internal/message_parts.h"
#include "plugins/values/internal/triangulation.h"

namespace runnel::internal {

namespace {

constexpr Colour kGoal{0.13, 0.60, 0.33};
constexpr Colour kStart{0.35, 0.40, 0.48};
constexpr Colour kHit{0.84, 0.22, 0.20};
constexpr Colour kLeave{0.13, 0.44, 0.85};
constexpr Colour kWall{0.62, 0.67, 0.74, 0.9};
constexpr Colour kEdge{0.36, 0.41, 0.49};
constexpr Colour kBounds{0.80, 0.55, 0.20};

constexpr double kBall = 0.2;        // m across
constexpr double kLineWidth = 0.02;  // m
constexpr double kTextHeight = 0.2;  // m

/// The things that are drawn. A later one of the same id takes its place.
class Scene {
 public:
  Scene(std::string& json, Time timestamp)
      : timestamp_(timestamp), update_(json), entities_(update_.AddJson("deletions", "[]").Key("entities")) {}

  /// `fill` adds to a thing what it is made of.
  template <typename Fill>
  void Add(std::string_view id, const Fill& fill, std::string_view frame = kWorldFrame) {
    JsonObject entity(entities_.Next());
    AppendTime(timestamp_, entity.Key("timestamp"));
    entity.Add("frame_id", frame).Add("id", id);
    entity.AddJson("lifetime", R"({"sec":0,"nsec":0})");  // until it is replaced
    entity.Add("frame_locked", true).AddJson("metadata", "[]");
    fill(entity);
  }

 private:
  const Time timestamp_;
  JsonObject update_;
  JsonArray entities_;
};

void AppendBall(const Place& place, const Colour& colour, std::string& json, double size = kBall) {
  JsonObject ball(json);
  AppendPose({place, 0.0}, ball.Key("pose"));
  AppendVector({size, size, size}, ball.Key("size"));
  AppendColour(colour, ball.Key("color"));
}

void AppendLabel(const Place& place, std::string_view text, double size, const Colour& colour, std::string& json) {
  JsonObject label(json);
  AppendPose({place, 0.0}, label.Key("pose"));
  label.Add("billboard", true).Add("font_size", size).Add("scale_invariant", false);
  AppendColour(colour, label.Key("color"));
  label.Add("text", text);
}

// `height` above where its points are.
void AppendLine(const ValueView& points, double height, const Colour& colour, std::string& json, bool is_closed = true,
                double width = kLineWidth) {
  JsonObject line(json);
  line.Add("type", is_closed ? 1 : 0);  // LINE_LOOP, LINE_STRIP
  AppendPose({}, line.Key("pose"));
  line.Add("thickness", width).Add("scale_invariant", false);
  {
    JsonArray list(line.Key("points"));
    for (std::size_t i = 0; i < points.size(); ++i) {
      Place place = PlaceOf(points[i]);
      place.z += height;
      AppendVector(place, list.Next());
    }
  }
  AppendColour(colour, line.Key("color"));
  line.AddJson("colors", "[]").AddJson("indices", "[]");
}

double HeightOf(const ValueView& outline) {
  return HasNumbers(outline.type(), {"height"}) ? outline.Field("height").number() : 0.0;
}

// For each outline the lines on the ground, and those at its top.
void AppendLines(const ValueView& map, std::string& json) {
  JsonArray lines(json);
  const ValueView outlines = map.Field("outlines");
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    const ValueView points = outlines[i].Field("points");
    AppendLine(points, 0.0, kEdge, lines.Next());
    const double height = HeightOf(outlines[i]);
    if (height > 0) AppendLine(points, height, kEdge, lines.Next());
  }
  if (HasPlaces(map.type(), "bounds") && map.Field("bounds").size() > 0) {
    AppendLine(map.Field("bounds"), 0.0, kBounds, lines.Next());
  }
}

// What has holes is left open at its top.
bool HasTop(const ValueView& outlines, std::size_t outline) {
  const auto is_hole = [&](std::size_t at) {
    if (at >= outlines.size()) return false;
    const FieldInfo* const field = outlines[at].type().FindField("is_hole");
    return field != nullptr && field->type == &TypeOf<bool>() &&
           *static_cast<const bool*>(outlines[at].Field("is_hole").value());
  };
  return !is_hole(outline) && !is_hole(outline + 1);
}

// The upright sides of all outlines, and their tops, as one list of triangles: each point of an outline has one on the
// ground and one at the top, and two triangles join it to the next.
void AppendSides(const ValueView& map, std::string& json) {
  JsonArray lists(json);
  JsonObject triangles(lists.Next());
  AppendPose({}, triangles.Key("pose"));
  std::string corners;
  {
    JsonArray points(triangles.Key("points"));
    JsonArray indices(corners);
    std::size_t first = 0;
    const ValueView outlines = map.Field("outlines");
    for (std::size_t i = 0; i < outlines.size(); ++i) {
      const double height = HeightOf(outlines[i]);
      const ValueView places = outlines[i].Field("points");
      const std::size_t count = places.size();
      std::vector<Place> ring;
      for (std::size_t k = 0; k < count; ++k) {
        Place place = PlaceOf(places[k]);
        ring.push_back(place);
        AppendVector(place, points.Next());
        place.z += height;
        AppendVector(place, points.Next());
        const std::size_t here = first + 2 * k, next = first + 2 * ((k + 1) % count);
        for (const std::size_t index : {here, next, here + 1, here + 1, next, next + 1}) {
          AppendJsonNumber(index, indices.Next());
        }
      }
      if (!HasTop(outlines, i)) ring.clear();
      for (const auto& triangle : TrianglesOf(ring)) {
        for (const std::size_t corner : triangle) {
          AppendJsonNumber(first + 2 * corner + 1, indices.Next());
        }
      }
      first += 2 * count;
    }
  }
  AppendColour(kWall, triangles.Key("color"));
  triangles.AddJson("colors", "[]").AddJson("indices", corners);
}

void AppendStart(const PlaceAndHeading& start, std::string& json) {
  JsonArray arrows(json);
  JsonObject arrow(arrows.Next());
  AppendPose(start, arrow.Key("pose"));
  arrow.Add("shaft_length", 0.25).Add("shaft_diameter", 0.05);
  arrow.Add("head_length", 0.12).Add("head_diameter", 0.12);
  AppendColour(kStart, arrow.Key("color"));
}

void AddGoal(Scene& scene, std::string_view id, const ValueView& goal) {
  scene.Add(id, [&](JsonObject& entity) {
    JsonArray balls(entity.Key("spheres"));
    AppendBall(PlaceOf(goal), kGoal, balls.Next());
  });
}

void AddNumbered(Scene& scene, const ValueView& places, const std::string& name, const Colour& colour) {
  scene.Add(name, [&](JsonObject& entity) {
    {
      JsonArray balls(entity.Key("spheres"));
      for (std::size_t i = 0; i < places.size(); ++i) {
        AppendBall(PlaceOf(places[i]), colour, balls.Next());
      }
    }
    JsonArray labels(entity.Key("texts"));
    for (std::size_t i = 0; i < places.size(); ++i) {
      Place above = PlaceOf(places[i]);
      above.z += kBall;
      AppendLabel(above, name + " " + std::to_string(i + 1), kTextHeight, colour, labels.Next());
    }
  });
}

// What a drawing says of one of its items.
struct Item {
  std::string_view kind;
  ValueView points;
  Colour colour;
  double size;
  std::string_view text;
};

std::string_view TextOf(const ValueView& value) { return *static_cast<const std::string*>(value.value()); }

Item ItemOf(const ValueView& value) {
  const ValueView kind = value.Field("kind");
  const ValueView colour = value.Field("colour");
  const std::int64_t number = kind.type().enumeration().get(kind.value());
  const auto& names = kind.type().enumerators();
  const auto named = std::ranges::find(names, number, &EnumeratorInfo::value);
  return {named == names.end() ? std::string_view() : named->name,
          value.Field("points"),
          {colour.Field("red").number(), colour.Field("green").number(), colour.Field("blue").number(),
           colour.Field("alpha").number()},
          value.Field("size").number(),
          TextOf(value.Field("text"))};
}

bool IsText(const TypeInfo& type, std::string_view name) {
  const FieldInfo* const field = type.FindField(name);
  return field != nullptr && field->type == &TypeOf<std::string>();
}

bool HasItems(const TypeInfo& type) {
  const TypeInfo* const item = ElementsOf(type, "items");
  if (item == nullptr || !IsText(type, "frame") || !HasPlaces(*item, "points")) return false;
  const FieldInfo* const kind = item->FindField("kind");
  const FieldInfo* const colour = item->FindField("colour");
  return kind != nullptr && kind->type->kind() == TypeKind::kEnumeration && colour != nullptr &&
         HasNumbers(*colour->type, {"red", "green", "blue", "alpha"}) && HasNumbers(*item, {"size"}) &&
         IsText(*item, "text");
}

void AppendDrawing(const ValueView& drawing, Time timestamp, std::string& json) {
  const std::string_view frame = TextOf(drawing.Field("frame"));
  const ValueView values = drawing.Field("items");
  std::vector<Item> items;
  for (std::size_t i = 0; i < values.size(); ++i) items.push_back(ItemOf(values[i]));
  const auto add = [&](std::string& list, std::string_view kind, std::string_view or_kind,
                       void (*append)(const Item&, std::string&)) {
    JsonArray array(list);
    for (const Item& each : items) {
      const bool is_it = each.kind == kind || each.kind == or_kind;
      if (is_it && each.points.size() > 0) append(each, array.Next());
    }
  };
  Scene scene(json, timestamp);
  const auto fill = [&](JsonObject& entity) {
    {
      JsonArray balls(entity.Key("spheres"));
      for (const Item& each : items) {
        if (each.kind != "points") continue;
        for (std::size_t i = 0; i < each.points.size(); ++i) {
          AppendBall(PlaceOf(each.points[i]), each.colour, balls.Next(), each.size);
        }
      }
    }
    add(entity.Key("lines"), "line", "closed_line", [](const Item& item, std::string& to) {
      AppendLine(item.points, 0.0, item.colour, to, item.kind == "closed_line", item.size);
    });
    add(entity.Key("texts"), "text", "text", [](const Item& item, std::string& to) {
      AppendLabel(PlaceOf(item.points[0]), item.text, item.size, item.colour, to);
    });
  };
  scene.Add("drawing", fill, frame.empty() ? kWorldFrame : frame);
}

// Of what else a map may have, nothing is drawn if it is not there.
bool HasOutlines(const TypeInfo& type) {
  const TypeInfo* const outline = ElementsOf(type, "outlines");
  return outline != nullptr && HasPlaces(*outline, "points");
}

void AppendPoint(const ValueView& point, Time timestamp, std::string& json) {
  Scene scene(json, timestamp);
  AddGoal(scene, "point", point);
}

void AppendHitAndLeavePoints(const ValueView& points, Time timestamp, std::string& json) {
  Scene scene(json, timestamp);
  AddNumbered(scene, points.Field("hits"), "hit", kHit);
  AddNumbered(scene, points.Field("leaves"), "leave", kLeave);
}

void AppendWorldMap(const ValueView& map, Time timestamp, std::string& json) {
  const auto has = [&](std::string_view name, bool (*fits)(const TypeInfo& type)) {
    const FieldInfo* const field = map.type().FindField(name);
    return field != nullptr && fits(*field->type);
  };
  Scene scene(json, timestamp);
  scene.Add("obstacles", [&](JsonObject& entity) {
    AppendLines(map, entity.Key("lines"));
    AppendSides(map, entity.Key("triangles"));
  });
  if (has("start", IsPose)) {
    scene.Add("start", [&](JsonObject& entity) { AppendStart(PoseOf(map.Field("start")), entity.Key("arrows")); });
  }
  if (has("goal", IsPlace)) AddGoal(scene, "goal", map.Field("goal"));
}

}  // namespace

const Drawing kPointDrawing{"point", "SceneUpdate", IsPlace, AppendPoint};
const Drawing kHitAndLeavePointsDrawing{
    "hit_and_leave_points", "SceneUpdate",
    [](const TypeInfo& type) { return HasPlaces(type, "hits") && HasPlaces(type, "leaves"); }, AppendHitAndLeavePoints};
const Drawing kDrawingDrawing{"drawing", "SceneUpdate", HasItems, AppendDrawing};
const Drawing kWorldMapDrawing{"world_map", "SceneUpdate", HasOutlines, AppendWorldMap};

}  // namespace runnel::internal

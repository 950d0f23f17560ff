#include <optional>
#include <string_view>
#include <vector>

#include "core/types/type_of.h"
#include "plugins/foxglove_schemas/internal/drawing.h"
#include "plugins/foxglove_schemas/internal/fields.h"
#include "plugins/foxglove_schemas/internal/message_parts.h"
#include "plugins/foxglove_schemas/internal/schema_texts.h"
#include "plugins/foxglove_schemas/internal/triangulation.h"

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

// Called with the list of entities, for each entity to be appended to it.
template <typename AddEntities>
void AppendScene(std::string& json, const AddEntities& add) {
  JsonObject update(json);
  update.AddJson("deletions", "[]");
  JsonArray entities(update.Key("entities"));
  add(entities);
}

/// One thing in a scene. A later one of the same id takes its place.
class Entity {
 public:
  Entity(JsonArray& entities, std::string_view id, const std::string& frame, Time timestamp)
      : object_(entities.Next()) {
    AppendTime(timestamp, object_.Key("timestamp"));
    object_.Add("frame_id", frame);
    object_.Add("id", id);
    object_.AddJson("lifetime", R"({"sec":0,"nsec":0})");  // until it is replaced
    object_.Add("frame_locked", true);
    object_.AddJson("metadata", "[]");
  }
  std::string& Key(std::string_view name) { return object_.Key(name); }

 private:
  JsonObject object_;
};

void AppendBall(const Place& place, const Colour& colour, std::string& json) {
  JsonObject ball(json);
  AppendPose({place, 0.0}, ball.Key("pose"));
  AppendVector({kBall, kBall, kBall}, ball.Key("size"));
  AppendColour(colour, ball.Key("color"));
}

void AppendLabel(const Place& place, const std::string& text, const Colour& colour,
                 std::string& json) {
  JsonObject label(json);
  AppendPose({{place.x, place.y, place.z + kBall}, 0.0}, label.Key("pose"));
  label.Add("billboard", true);
  label.Add("font_size", kTextHeight);
  label.Add("scale_invariant", false);
  AppendColour(colour, label.Key("color"));
  label.Add("text", text);
}

// A closed line, `height` above where its points are.
void AppendRing(const PlacesField& points, const void* value, double height, const Colour& colour,
                std::string& json) {
  JsonObject line(json);
  line.Add("type", 1);  // LINE_LOOP
  AppendPose({}, line.Key("pose"));
  line.Add("thickness", kLineWidth);
  line.Add("scale_invariant", false);
  {
    JsonArray list(line.Key("points"));
    for (std::size_t i = 0; i < points.Size(value); ++i) {
      Place place = points.At(value, i);
      place.z += height;
      AppendVector(place, list.Next());
    }
  }
  AppendColour(colour, line.Key("color"));
  line.AddJson("colors", "[]");
  line.AddJson("indices", "[]");
}

/// The fields of a map; of those that are not there, nothing is drawn.
struct MapFields {
  std::optional<PlacesField> bounds;
  std::optional<ListField> outlines;
  std::optional<PlacesField> points;  // of an outline
  std::optional<NumberField> height;  // of an outline
  const FieldInfo* is_hole;           // of an outline; nullptr if none is
  const FieldInfo* start_field;
  std::optional<PoseReader> start;
  const FieldInfo* goal_field;
  std::optional<PlaceReader> goal;
};

std::optional<MapFields> FindMap(const TypeInfo& type) {
  MapFields fields{};
  fields.bounds = PlacesField::Find(type, "bounds");
  fields.outlines = ListField::Find(type, "outlines");
  if (!fields.outlines) return std::nullopt;
  fields.points = PlacesField::Find(fields.outlines->element_type(), "points");
  if (!fields.points) return std::nullopt;
  fields.height = NumberField::Find(fields.outlines->element_type(), "height");
  fields.is_hole = fields.outlines->element_type().FindField("is_hole");
  if (fields.is_hole != nullptr && fields.is_hole->type != &TypeOf<bool>()) {
    fields.is_hole = nullptr;
  }
  fields.start_field = type.FindField("start");
  if (fields.start_field != nullptr) fields.start = PoseReader::For(*fields.start_field->type);
  fields.goal_field = type.FindField("goal");
  if (fields.goal_field != nullptr) fields.goal = PlaceReader::For(*fields.goal_field->type);
  return fields;
}

double HeightOf(const MapFields& fields, const void* outline) {
  return fields.height ? fields.height->Get(outline) : 0.0;
}

// For each outline the lines on the ground, and those at its top.
void AppendLines(const MapFields& fields, const void* value, std::string& json) {
  JsonArray lines(json);
  for (std::size_t i = 0; i < fields.outlines->Size(value); ++i) {
    const void* const outline = fields.outlines->At(value, i);
    AppendRing(*fields.points, outline, 0.0, kEdge, lines.Next());
    const double height = HeightOf(fields, outline);
    if (height > 0) AppendRing(*fields.points, outline, height, kEdge, lines.Next());
  }
  if (fields.bounds && fields.bounds->Size(value) > 0) {
    AppendRing(*fields.bounds, value, 0.0, kBounds, lines.Next());
  }
}

bool IsHole(const MapFields& fields, const void* outline) {
  return fields.is_hole != nullptr &&
         *static_cast<const bool*>(fields.is_hole->address(ForLooking(outline)));
}

// What has holes is left open at its top.
bool HasTop(const MapFields& fields, const void* value, std::size_t outline) {
  const auto is_hole = [&](std::size_t at) {
    return at < fields.outlines->Size(value) && IsHole(fields, fields.outlines->At(value, at));
  };
  return !is_hole(outline) && !is_hole(outline + 1);
}

// The upright sides of all outlines, and their tops, as one list of triangles: each point of an outline has one on the
// ground and one at the top, and two triangles join it to the next.
void AppendSides(const MapFields& fields, const void* value, std::string& json) {
  JsonArray lists(json);
  JsonObject triangles(lists.Next());
  AppendPose({}, triangles.Key("pose"));
  std::string corners;
  {
    JsonArray points(triangles.Key("points"));
    JsonArray indices(corners);
    std::size_t first = 0;
    for (std::size_t i = 0; i < fields.outlines->Size(value); ++i) {
      const void* const outline = fields.outlines->At(value, i);
      const double height = HeightOf(fields, outline);
      const std::size_t count = fields.points->Size(outline);
      std::vector<Place> ring;
      for (std::size_t k = 0; k < count; ++k) {
        Place place = fields.points->At(outline, k);
        ring.push_back(place);
        AppendVector(place, points.Next());
        place.z += height;
        AppendVector(place, points.Next());
        const std::size_t here = first + 2 * k, next = first + 2 * ((k + 1) % count);
        for (const std::size_t index : {here, next, here + 1, here + 1, next, next + 1}) {
          AppendJsonNumber(std::uint64_t{index}, indices.Next());
        }
      }
      if (!HasTop(fields, value, i)) ring.clear();
      for (const auto& triangle : TrianglesOf(ring)) {
        for (const std::size_t corner : triangle) {
          AppendJsonNumber(std::uint64_t{first + 2 * corner + 1}, indices.Next());
        }
      }
      first += 2 * count;
    }
  }
  AppendColour(kWall, triangles.Key("color"));
  triangles.AddJson("colors", "[]");
  triangles.AddJson("indices", corners);
}

void AppendStart(const PlaceAndHeading& start, std::string& json) {
  JsonArray arrows(json);
  JsonObject arrow(arrows.Next());
  AppendPose(start, arrow.Key("pose"));
  arrow.Add("shaft_length", 0.25);
  arrow.Add("shaft_diameter", 0.05);
  arrow.Add("head_length", 0.12);
  arrow.Add("head_diameter", 0.12);
  AppendColour(kStart, arrow.Key("color"));
}

void AppendNumbered(JsonArray& entities, const PlacesField& places, const void* value,
                    const std::string& name, const Colour& colour, const std::string& frame,
                    Time timestamp) {
  Entity entity(entities, name, frame, timestamp);
  {
    JsonArray balls(entity.Key("spheres"));
    for (std::size_t i = 0; i < places.Size(value); ++i) {
      AppendBall(places.At(value, i), colour, balls.Next());
    }
  }
  JsonArray labels(entity.Key("texts"));
  for (std::size_t i = 0; i < places.Size(value); ++i) {
    AppendLabel(places.At(value, i), name + " " + std::to_string(i + 1), colour, labels.Next());
  }
}

}  // namespace

std::optional<Drawing> DrawPoint(const TypeInfo& type, const FoxgloveOptions& options) {
  const auto place = PlaceReader::For(type);
  if (!place) return std::nullopt;
  return Drawing{"foxglove.SceneUpdate", SceneUpdateSchema(),
                 [place = *place, frame = options.world_frame](const void* value, Time timestamp,
                                                               std::string& json) {
                   AppendScene(json, [&](JsonArray& entities) {
                     Entity entity(entities, "point", frame, timestamp);
                     JsonArray balls(entity.Key("spheres"));
                     AppendBall(place.Get(value), kGoal, balls.Next());
                   });
                 }};
}

std::optional<Drawing> DrawHitAndLeavePoints(const TypeInfo& type, const FoxgloveOptions& options) {
  const auto hits = PlacesField::Find(type, "hits"), leaves = PlacesField::Find(type, "leaves");
  if (!hits || !leaves) return std::nullopt;
  return Drawing{"foxglove.SceneUpdate", SceneUpdateSchema(),
                 [hits = *hits, leaves = *leaves, frame = options.world_frame](
                     const void* value, Time timestamp, std::string& json) {
                   AppendScene(json, [&](JsonArray& entities) {
                     AppendNumbered(entities, hits, value, "hit", kHit, frame, timestamp);
                     AppendNumbered(entities, leaves, value, "leave", kLeave, frame, timestamp);
                   });
                 }};
}

std::optional<Drawing> DrawWorldMap(const TypeInfo& type, const FoxgloveOptions& options) {
  const auto fields = FindMap(type);
  if (!fields) return std::nullopt;
  return Drawing{"foxglove.SceneUpdate", SceneUpdateSchema(),
                 [fields = *fields, frame = options.world_frame](const void* value, Time timestamp,
                                                                 std::string& json) {
                   AppendScene(json, [&](JsonArray& entities) {
                     {
                       Entity obstacles(entities, "obstacles", frame, timestamp);
                       AppendLines(fields, value, obstacles.Key("lines"));
                       AppendSides(fields, value, obstacles.Key("triangles"));
                     }
                     if (fields.start) {
                       Entity entity(entities, "start", frame, timestamp);
                       AppendStart(
                           fields.start->Get(fields.start_field->address(ForLooking(value))),
                           entity.Key("arrows"));
                     }
                     if (fields.goal) {
                       Entity entity(entities, "goal", frame, timestamp);
                       JsonArray balls(entity.Key("spheres"));
                       AppendBall(fields.goal->Get(fields.goal_field->address(ForLooking(value))),
                                  kGoal, balls.Next());
                     }
                   });
                 }};
}

}  // namespace runnel::internal

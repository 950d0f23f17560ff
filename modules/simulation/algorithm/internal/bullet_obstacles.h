#pragma once

#include <memory>
#include <utility>
#include <vector>

#include <btBulletDynamicsCommon.h>

#include "modules/simulation/algorithm/outline.h"
#include "modules/simulation/algorithm/world.h"
#include "modules/simulation/algorithm/world_geometry.h"

namespace runnel::internal {

/// The obstacles of a world as Bullet wants them: boxes, cylinders and walls solid, polygons and
/// bounds as upright triangles that stop from both sides (a robot that starts outside of a polygon
/// never gets into it, so that it need not be solid).
///
/// Ownership: owns every shape and object; take them out of Bullet's world first, then destroy.
class BulletObstacles {
 public:
  /// What has no height of its own gets `bounds_height` (m).
  BulletObstacles(const World& world, double bounds_height) {
    for (const BoxObstacle& box : world.boxes) AddBox(box);
    for (const CylinderObstacle& cylinder : world.cylinders) AddCylinder(cylinder);
    for (const WallObstacle& wall : world.walls) AddWall(wall);
    for (const PolygonObstacle& polygon : world.polygons) {
      AddRing(polygon.outline, polygon.height);
      for (const Ring& hole : polygon.holes) AddRing(hole, polygon.height);
    }
    if (world.bounds) AddRing(*world.bounds, bounds_height);
    if (triangles_.getNumTriangles() == 0) return;
    AddObject(std::make_unique<btBvhTriangleMeshShape>(&triangles_, false), btTransform::getIdentity());
  }

  void AddTo(btDynamicsWorld& world) const {
    for (const auto& object : objects_) {
      world.addCollisionObject(object.get(), btBroadphaseProxy::StaticFilter,
                               btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter);
    }
  }

  void RemoveFrom(btDynamicsWorld& world) const {
    for (const auto& object : objects_) world.removeCollisionObject(object.get());
  }

 private:
  static btTransform Place(Point2 centre, double heading, double height) {
    return btTransform(btQuaternion(btVector3(0, 0, 1), heading), btVector3(centre.x, centre.y, height / 2));
  }

  void AddBox(const BoxObstacle& box) {
    AddObject(std::make_unique<btBoxShape>(btVector3(box.length, box.width, box.height) / 2),
              Place(Position(box.pose), box.pose.heading, box.height));
  }

  void AddCylinder(const CylinderObstacle& cylinder) {
    AddObject(std::make_unique<btCylinderShapeZ>(btVector3(cylinder.radius, cylinder.radius, cylinder.height / 2)),
              Place(cylinder.centre, 0.0, cylinder.height));
  }

  void AddWall(const WallObstacle& wall) {
    for (const Segment2& piece : PiecesOf(wall.points)) {
      AddBox(StraightPart(piece, wall.thickness, wall.height));
    }
    for (const Point2 point : wall.points) AddCylinder({point, wall.thickness / 2, wall.height});
  }

  void AddRing(const Ring& ring, double height) {
    for (const Segment2& side : SidesOf(ring)) {
      const btVector3 a(side.from.x, side.from.y, 0), b(side.to.x, side.to.y, 0);
      const btVector3 up(0, 0, height);
      triangles_.addTriangle(a, b, b + up);
      triangles_.addTriangle(a, b + up, a + up);
    }
  }

  void AddObject(std::unique_ptr<btCollisionShape> shape, const btTransform& place) {
    auto object = std::make_unique<btCollisionObject>();
    object->setCollisionShape(shape.get());
    object->setWorldTransform(place);
    object->setFriction(1.0);  // Bullet multiplies both bodies' coefficients: the robot's counts
    shapes_.push_back(std::move(shape));
    objects_.push_back(std::move(object));
  }

  btTriangleMesh triangles_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
};

}  // namespace runnel::internal

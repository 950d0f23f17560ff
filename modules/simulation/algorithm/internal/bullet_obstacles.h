#pragma once

#include <memory>
#include <vector>

#include <btBulletDynamicsCommon.h>

#include "modules/simulation/algorithm/world.h"

namespace runnel::internal {

/// The obstacles of a world as Bullet wants them: boxes, cylinders and walls solid, polygons and
/// bounds as upright triangles that stop from both sides (a robot that starts outside of a polygon
/// never gets into it, so that it need not be solid).
///
/// Ownership: owns every shape and object; take them out of Bullet's world first, then destroy.
class BulletObstacles {
 public:
  /// What has no height of its own gets `bounds_height` (m).
  BulletObstacles(const World& world, double bounds_height);

  void AddTo(btDynamicsWorld& world) const;
  void RemoveFrom(btDynamicsWorld& world) const;

 private:
  void AddBox(const BoxObstacle& box);
  void AddCylinder(const CylinderObstacle& cylinder);
  void AddWall(const WallObstacle& wall);
  void AddRing(const Ring& ring, double height);
  void AddObject(std::unique_ptr<btCollisionShape> shape, const btTransform& place);

  btTriangleMesh triangles_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
};

}  // namespace runnel::internal

// What the graphics card holds of an object is given back.

export function Release(object) {
  object.removeFromParent();
  object.traverse((each) => {
    each.geometry?.dispose();
    for (const material of [each.material ?? []].flat()) {
      material.map?.dispose();
      material.dispose();
    }
  });
}

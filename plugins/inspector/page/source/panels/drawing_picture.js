// What a module draws, as a small picture that shows all of it.

import { useEffect, useRef } from 'preact/hooks';
import { html } from 'htm/preact';
import { AreaOf, FitCamera } from '../world/camera.js';
import { DrawItems } from '../world/draw.js';
import { useWatched } from './use_watched.js';

const kOrigin = { x: 0, y: 0, heading: 0 };

export function DrawingPicture({ path, width = 260, height = 170 }) {
  const canvas = useRef(null);
  const item = useWatched(path, { rate: 10, elements: 2000 });
  useEffect(() => {
    if (item && canvas.current) Draw(canvas.current, item.value, { width, height });
  }, [item, width, height]);
  return html`<figure class="drawing" data-drawing=${path}>
    <canvas ref=${canvas} style=${{ width: `${width}px`, height: `${height}px` }}
      role="img" aria-label=${`what ${path} draws`} />
    ${!item && html`<figcaption class="none">nothing has come yet</figcaption>`}</figure>`;
}

function Draw(canvas, value, size) {
  const ratio = devicePixelRatio || 1;
  canvas.width = size.width * ratio;
  canvas.height = size.height * ratio;
  canvas.dataset.items = String(value.items?.length ?? 0);
  const context = canvas.getContext('2d');
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  const area = AreaOf((value.items ?? []).flatMap((each) => each.points));
  if (area) DrawItems({ context, camera: FitCamera(area, size, 10), size }, value, kOrigin);
}

// A picture that a port has, fetched only while it is seen.

import { useEffect, useRef, useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { PixelsOf } from '../model/image_pixels.js';
import { watches } from '../state/store.js';

const kRate = 10; // pictures a second at most

export function ImagePicture({ path }) {
  const frame = useRef(null);
  const canvas = useRef(null);
  const [isSeen, setSeen] = useState(false);
  const [told, setTold] = useState(null); // {text, problem}
  useEffect(() => {
    const observer = new IntersectionObserver(([entry]) => setSeen(entry.isIntersecting));
    observer.observe(frame.current);
    return () => observer.disconnect();
  }, []);
  useEffect(() => {
    if (!isSeen) return undefined;
    return watches.watch(path, { rate: kRate, as: 'image', onValue: (item) => setTold(item ? Draw(canvas.current, item) : null) }).end;
  }, [path, isSeen]);
  return html`<figure class="picture" data-picture=${path} ref=${frame}>
    <canvas ref=${canvas} role="img" aria-label=${`picture of ${path}`} hidden=${!told || told.problem !== ''} />
    <figcaption class=${told?.problem ? 'problem' : 'note'}>${told ? told.problem || told.text : 'no picture has come yet'}</figcaption></figure>`;
}

function Draw(canvas, { value }) {
  const { pixels, problem } = PixelsOf(value);
  if (problem) return { text: '', problem };
  if (canvas.width !== value.width || canvas.height !== value.height) Object.assign(canvas, { width: value.width, height: value.height });
  canvas.getContext('2d').putImageData(new ImageData(pixels, value.width, value.height), 0, 0);
  canvas.dataset.count = String(Number(canvas.dataset.count ?? 0) + 1);
  return { text: `${value.width} × ${value.height} ${value.encoding}`, problem: '' };
}

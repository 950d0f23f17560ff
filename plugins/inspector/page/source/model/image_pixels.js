// A picture as a browser draws it: red, green, blue and opacity of each pixel.

// bytes of a pixel, and where in them its colours are
const kEncodings = {
  __proto__: null, // an encoding may be called anything
  rgb8: [3, 0, 1, 2], bgr8: [3, 2, 1, 0], rgba8: [4, 0, 1, 2], bgra8: [4, 2, 1, 0],
  mono8: [1, 0, 0, 0], '8UC1': [1, 0, 0, 0], '8UC3': [3, 2, 1, 0], mono16: [2, 1, 1, 1], '16UC1': [2, 1, 1, 1],
};

/** Of {width, height, encoding, step, data: base64}: {pixels} for ImageData, or {problem}. */
export function PixelsOf({ width, height, encoding, step, data }) {
  const layout = kEncodings[encoding];
  if (typeof data !== 'string') return { problem: 'this picture is too large to be shown' };
  if (!layout) return { problem: `pictures of '${encoding}' cannot be shown` };
  const [size, red, green, blue] = layout;
  const bytes = Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
  const row = step || width * size;
  if (!(width > 0 && height > 0) || row < width * size || bytes.length < row * (height - 1) + width * size) {
    return { problem: 'this picture is not whole' };
  }
  const pixels = new Uint8ClampedArray(width * height * 4);
  for (let y = 0, to = 0; y < height; ++y) {
    for (let x = 0, from = y * row; x < width; ++x, from += size, to += 4) {
      pixels[to] = bytes[from + red];
      pixels[to + 1] = bytes[from + green];
      pixels[to + 2] = bytes[from + blue];
      pixels[to + 3] = 255;
    }
  }
  return { pixels };
}

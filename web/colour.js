// Colours: maps from [0, 1] to RGB as a few stops, linear in between.

const hex = (list) => list.split(' ').map((word) => [0, 2, 4].map((k) => parseInt(word.slice(k, k + 2), 16)));

export const maps = {
  viridis: hex('440154 482878 3e4989 31688e 26828e 1f9e89 35b779 6ece58 b5de2b fde725'),
  balance: hex('123f8c 3a76c4 8db8e0 d9e7f0 f6f4f0 f3dccb e3a583 c65a45 8f1222'),
  deep: hex('f2f7f9 c6dfe8 8fc0d4 5a9bbd 37749f 274f7c 1b2d52'),
  sand: hex('e8cf98 e3b768 db9442 c96a2c a63f22 7a1f1c'),
};

export function colourAt(map, s) {
  const stops = maps[map];
  const place = Math.min(1, Math.max(0, Number.isFinite(s) ? s : 0)) * (stops.length - 1);
  const k = Math.min(stops.length - 2, Math.floor(place));
  return stops[k].map((c, n) => Math.round(c + (stops[k + 1][n] - c) * (place - k)));
}

/// 256 colours, RGBA.
export function palette(map) {
  const rgba = new Uint8Array(1024);
  for (let n = 0; n < 256; ++n) rgba.set([...colourAt(map, n / 255), 255], 4 * n);
  return rgba;
}

export const gradient = (map) => `linear-gradient(to right, ${maps[map].map((c) => `rgb(${c})`).join(', ')})`;

/// A picture of nx x ny values (x fastest, the first row at the bottom) as a data URL; NaN stays clear.
export function heatUrl(values, nx, ny, from, to, map) {
  const canvas = document.createElement('canvas');
  canvas.width = nx;
  canvas.height = ny;
  const image = new ImageData(nx, ny);
  for (let j = 0; j < ny; ++j)
    for (let i = 0; i < nx; ++i) {
      const v = values[j * nx + i];
      if (Number.isFinite(v)) image.data.set([...colourAt(map, (v - from) / (to - from)), 255], 4 * ((ny - 1 - j) * nx + i));
    }
  canvas.getContext('2d').putImageData(image, 0, 0);
  return canvas.toDataURL();
}

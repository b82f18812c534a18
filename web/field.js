// Fields of a frame: the quantity behind the grains, and streamlines.

import { numbers } from './pack.js';

/// What can be drawn: unit, colours, whether zero is the middle of the scale.
export const quantities = {
  speed: { name: 'speed of the water', unit: 'm/s', map: 'viridis', of: speed },
  vorticity: { name: 'vorticity', unit: '1/s', map: 'balance', balanced: true, of: vorticity },
  pressure: { name: 'pressure', unit: 'Pa', map: 'balance', balanced: true, of: (f) => f.p && centred(f.p) },
  solid: { name: 'solid fraction', unit: '-', map: 'deep', from: 0, to: 0.65, of: (f) => f.solid },
};

/// The packed frame with its fields as numbers.
export function opened(pack) {
  const frame = { ...pack.head, x: pack.x.raw, y: pack.y.raw, pack };
  for (const name of ['u', 'v', 'p', 'solid', 'open']) if (pack[name]) frame[name] = numbers(pack[name]);
  return frame;
}

function speed({ u, v }) {
  const out = new Float32Array(u.length);
  for (let n = 0; n < u.length; ++n) out[n] = Math.sqrt(u[n] * u[n] + v[n] * v[n]);
  return out;
}

const centres = (faces) => Float32Array.from({ length: faces.length - 1 }, (_, n) => 0.5 * (faces[n] + faces[n + 1]));

/// dv/dx - du/dy by central differences, one-sided at the rim.
function vorticity({ u, v, nx, ny, x, y }) {
  const xc = centres(x), yc = centres(y);
  const out = new Float32Array(nx * ny);
  for (let j = 0; j < ny; ++j) {
    const below = Math.max(0, j - 1), above = Math.min(ny - 1, j + 1);
    for (let i = 0; i < nx; ++i) {
      const west = Math.max(0, i - 1), east = Math.min(nx - 1, i + 1);
      out[j * nx + i] = (v[j * nx + east] - v[j * nx + west]) / (xc[east] - xc[west])
        - (u[above * nx + i] - u[below * nx + i]) / (yc[above] - yc[below]);
    }
  }
  return out;
}

/// The pressure less its mean: only differences of it have a meaning.
function centred(p) {
  const mean = p.reduce((sum, v) => sum + v, 0) / p.length;
  return p.map((v) => v - mean);
}

/// Ends of a colour scale that a few cells at a corner do not stretch: 0.5 % on either side may lie outside.
export function scaleOf(values, quantity) {
  if (quantity.to !== undefined) return [quantity.from, quantity.to];
  const step = Math.max(1, Math.floor(values.length / 20000));
  const sample = Float32Array.from({ length: Math.floor(values.length / step) }, (_, n) => values[n * step]).sort();
  const low = sample[Math.floor(0.005 * sample.length)], high = sample[Math.ceil(0.995 * sample.length) - 1];
  if (!quantity.balanced) return [0, Math.max(high, 1e-6)];
  const end = Math.max(-low, high, 1e-6);
  return [-end, end];
}

/// Stream function at cell centres in x and faces in y (ny + 1 rows): psi = integral of u dy from the floor [m2/s], in cells
/// that the pipe cuts through their open part.
export function streamFunction({ u, open, nx, ny, y }) {
  const psi = new Float32Array(nx * (ny + 1));
  for (let j = 0; j < ny; ++j)
    for (let i = 0; i < nx; ++i) psi[(j + 1) * nx + i] = psi[j * nx + i] + u[j * nx + i] * (open ? open[j * nx + i] : 1) * (y[j + 1] - y[j]);
  return psi;
}

/// Streamlines as lists of [x0, y0, x1, y1]: contours of the stream function, close about the pipe's (or the middle's)
/// value, where eddies are, and further apart in the stream.
export function streamlines(frame, pipe, levels = 12) {
  const psi = streamFunction(frame), { nx, ny, x, y } = frame;
  const stride = Math.max(1, Math.ceil(Math.sqrt((nx * ny) / 40000)));
  const xc = centres(x), is = [], js = [];
  for (let i = 0; i < nx; i += stride) is.push(i);
  for (let j = 0; j <= ny; j += stride) js.push(j);
  const first = (faces, s) => { const k = faces.findIndex((face) => face > s); return k < 0 ? faces.length - 1 : k; };
  const middle = pipe ? psi[first(y, pipe.y_m) * nx + Math.min(nx - 1, first(xc, pipe.x_m))] : psi[psi.length >> 1];
  const reach = psi.reduce((most, v) => Math.max(most, Math.abs(v - middle)), 0);
  const segments = [];
  for (let n = -levels; n <= levels; ++n) {
    const level = middle + Math.sign(n) * reach * (n / levels) ** 2;
    for (let b = 0; b + 1 < js.length; ++b)
      for (let a = 0; a + 1 < is.length; ++a) {
        const corners = [[is[a], js[b]], [is[a + 1], js[b]], [is[a + 1], js[b + 1]], [is[a], js[b + 1]]];
        const points = [];
        for (let k = 0; k < 4; ++k) {
          const [i0, j0] = corners[k], [i1, j1] = corners[(k + 1) % 4];
          const p = psi[j0 * nx + i0] - level, q = psi[j1 * nx + i1] - level;
          if (p < 0 === q < 0) continue;
          const s = p / (p - q);
          points.push(xc[i0] + s * (xc[i1] - xc[i0]), y[j0] + s * (y[j1] - y[j0]));
        }
        for (let k = 0; k + 3 < points.length; k += 4) segments.push(points.slice(k, k + 4));
      }
  }
  return segments;
}

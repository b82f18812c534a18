// Field and grains of a frame as pixels of a canvas.  Pixels are made by the processor: 200,000 grains of about a pixel
// take less time so than as points of a graphics card that is emulated, and look the same everywhere, also on paper.

import { palette } from './colour.js';

const colours = new Map();  // of each map, as pixels (A B G R)
function pixelsOf(map) {
  if (!colours.has(map)) colours.set(map, new Uint32Array(palette(map).buffer));
  return colours.get(map);
}

/// For n pixels from s0 in steps of h: the cell whose centre lies before each, and how far it is on the way to the next;
/// -1 outside the grid.
function places(faces, s0, h, n) {
  const cells = new Int32Array(n), shares = new Float32Array(n), last = faces.length - 2;
  const centre = (c) => 0.5 * (faces[c] + faces[c + 1]);
  for (let k = 0, c = 0; k < n; ++k) {
    const s = s0 + (k + 0.5) * h;
    if (s < faces[0] || s > faces[last + 1]) { cells[k] = -1; continue; }
    while (c < last - 1 && s > centre(c + 1)) ++c;
    cells[k] = Math.min(c, Math.max(0, last - 1));
    shares[k] = last < 1 ? 0 : Math.min(1, Math.max(0, (s - centre(c)) / (centre(c + 1) - centre(c))));
  }
  return { cells, shares };
}

/// a where share is 0, b where it is 1, channel by channel.
function mixed(a, b, share) {
  const k = Math.round(share * 256), l = 256 - k;
  const redBlue = (((a & 0xff00ff) * l + (b & 0xff00ff) * k) >>> 8) & 0xff00ff;
  const green = (((a & 0xff00) * l + (b & 0xff00) * k) >>> 8) & 0xff00;
  return (0xff000000 | redBlue | green) >>> 0;
}

export class Painter {
  constructor(canvas) {
    this.canvas = canvas;
    this.pen = canvas.getContext('2d', { alpha: false });
  }

  /// The frame (field.js) with the values to colour its cells by, between `from` and `to`.
  load(frame, values, from, to, map) {
    const scale = 255 / (to - from);
    this.levels = new Float32Array(values.length);
    for (let n = 0; n < values.length; ++n) this.levels[n] = Math.min(255, Math.max(0, (values[n] - from) * scale));
    this.colours = pixelsOf(map);
    this.frame = frame;
  }

  /// Draws the window {x0, y0, x1, y1} [m]; grains are coloured up to the speed `grainEnd`; paper: [r, g, b] outside the box.
  draw(window, { grains = true, grainEnd = 1, paper = [255, 255, 255] } = {}) {
    if (!this.frame) return;
    const { width, height } = this.canvas;
    if (this.image?.width !== width || this.image?.height !== height) {
      this.image = this.pen.createImageData(width, height);
      this.pixels = new Uint32Array(this.image.data.buffer);
    }
    this.#drawField(window, width, height, (0xff000000 | (paper[2] << 16) | (paper[1] << 8) | paper[0]) >>> 0);
    if (grains && this.frame.grains) this.#drawGrains(window, width, height, grainEnd);
    this.pen.putImageData(this.image, 0, 0);
  }

  #drawField(window, width, height, paper) {
    const { levels, colours: map, pixels } = this, { x, y, nx, ny } = this.frame;
    const columns = places(x, window.x0, (window.x1 - window.x0) / width, width), rows = places(y, window.y0, (window.y1 - window.y0) / height, height);
    const east = nx > 1 ? 1 : 0, north = ny > 1 ? nx : 0;
    for (let k = 0; k < height; ++k) {
      const j = rows.cells[height - 1 - k], t = rows.shares[height - 1 - k];
      for (let n = 0, at = k * width; n < width; ++n, ++at) {
        const i = columns.cells[n];
        if (i < 0 || j < 0) { pixels[at] = paper; continue; }
        const s = columns.shares[n], cell = j * nx + i;
        const below = levels[cell] + s * (levels[cell + east] - levels[cell]);
        const above = levels[cell + north] + s * (levels[cell + north + east] - levels[cell + north]);
        pixels[at] = map[(below + t * (above - below) + 0.5) | 0];
      }
    }
  }

  /// Discs with soft edges and, where there is room, a darker rim; what is smaller than a pixel is one.
  #drawGrains(window, width, height, grainEnd) {
    const { pixels } = this, { grain_x: gx, grain_y: gy, grain_d: gd, grain_speed: gs } = this.frame.pack, sand = pixelsOf('sand');
    const scale = width / (window.x1 - window.x0);
    const stepX = ((gx.to - gx.from) / 65535) * scale, startX = (gx.from - window.x0) * scale;
    const stepY = ((gy.to - gy.from) / 65535) * scale, startY = height - (gy.from - window.y0) * scale;
    const stepR = (0.5 * (gd.to - gd.from) * scale) / 255, startR = 0.5 * gd.from * scale;
    const stepC = (((gs.to - gs.from) / 65535) * 255) / grainEnd, startC = (gs.from * 255) / grainEnd;
    for (let n = 0; n < gx.raw.length; ++n) {
      const x = startX + stepX * gx.raw[n], y = startY - stepY * gy.raw[n], r = startR + stepR * gd.raw[n];
      if (x + r < 0 || x - r > width || y + r < 0 || y - r > height) continue;
      const colour = sand[Math.min(255, (startC + stepC * gs.raw[n]) | 0)];
      if (r < 0.55) {
        const i = x | 0, j = y | 0;
        if (i < width && j < height && x >= 0 && y >= 0) pixels[j * width + i] = colour;
        continue;
      }
      const rim = r > 3 ? mixed(colour, 0xff203040, 0.25) : colour;
      const core = Math.max(0, r - 1.5) ** 2, edge = (r + 0.5) ** 2;
      for (let j = Math.max(0, Math.floor(y - r - 0.5)); j <= Math.min(height - 1, Math.ceil(y + r)); ++j) {
        const dy = j + 0.5 - y, half = Math.sqrt(Math.max(0, edge - dy * dy));
        const to = Math.min(width - 1, Math.ceil(x + half));
        for (let i = Math.max(0, Math.floor(x - half)); i <= to; ++i) {
          const dx = i + 0.5 - x, square = dx * dx + dy * dy, at = j * width + i;
          if (square <= core) pixels[at] = colour;
          else if (square < edge) pixels[at] = mixed(pixels[at], rim, Math.min(1, r + 0.5 - Math.sqrt(square)));
        }
      }
    }
  }
}

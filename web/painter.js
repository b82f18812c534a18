// Field and grains of a frame drawn by WebGL2: the field as a texture on the stretched grid, each grain as a disc.

import { palette } from './colour.js';

const lookups = 2048;  // entries that turn a place into a column or row of the grid

const fieldVertex = `#version 300 es
uniform vec4 window; out vec2 place;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  place = mix(window.xy, window.zw, corner);
  gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
}`;
const fieldFragment = `#version 300 es
precision highp float;
uniform sampler2D field, columns, rows, colours; uniform vec4 box; uniform vec3 paper; in vec2 place; out vec4 colour;
float at(sampler2D table, float s) {
  float k = clamp(s, 0.0, 1.0) * float(${lookups - 1}), n = min(floor(k), float(${lookups - 2}));
  return mix(texelFetch(table, ivec2(int(n), 0), 0).r, texelFetch(table, ivec2(int(n) + 1, 0), 0).r, k - n);
}
void main() {
  vec2 s = (place - box.xy) / (box.zw - box.xy);
  if (any(lessThan(s, vec2(0.0))) || any(greaterThan(s, vec2(1.0)))) { colour = vec4(paper, 1.0); return; }
  float value = texture(field, vec2(at(columns, s.x), at(rows, s.y))).r;
  colour = vec4(texture(colours, vec2((255.0 * value + 0.5) / 256.0, 0.5)).rgb, 1.0);
}`;
// Points where discs are small: one vertex a grain; above 60 pixels, which not every machine draws as a point, four.
const grainVertex = `#version 300 es
uniform vec4 window, span; uniform vec2 diameters, pixels; uniform float fastest, slow; uniform bool quads;
in vec2 grain; in float size, speed;
out vec2 offset; out float radius, swift;
void main() {
  vec2 centre = mix(span.xy, span.zw, grain);
  float d = mix(diameters.x, diameters.y, size);
  vec2 scale = pixels / (window.zw - window.xy);
  radius = max(0.5 * d * scale.x, 0.6);
  swift = (slow + (fastest - slow) * speed);
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  offset = corner * (radius + 1.0);
  vec2 at = (centre - window.xy) * scale + (quads ? offset : vec2(0.0));
  gl_Position = vec4(2.0 * at / pixels - 1.0, 0.0, 1.0);
  gl_PointSize = 2.0 * radius + 2.0;
}`;
const grainFragment = `#version 300 es
precision highp float;
uniform sampler2D colours; uniform float end; uniform bool quads;
in vec2 offset; in float radius, swift; out vec4 colour;
void main() {
  vec2 from = quads ? offset : (gl_PointCoord - 0.5) * (2.0 * radius + 2.0);
  float r = length(from), cover = clamp(radius - r + 0.5, 0.0, 1.0);
  if (cover == 0.0) discard;
  float edge = radius > 3.0 ? 0.72 + 0.28 * clamp(radius - r, 0.0, 1.0) : 1.0;
  colour = vec4(texture(colours, vec2((255.0 * clamp(swift / end, 0.0, 1.0) + 0.5) / 256.0, 0.5)).rgb * edge, cover);
}`;

export class Painter {
  /// Throws when the browser has no WebGL2.
  constructor(canvas) {
    this.canvas = canvas;
    const gl = (this.gl = canvas.getContext('webgl2', { antialias: false, preserveDrawingBuffer: true }));
    if (!gl) throw new Error('this browser draws no WebGL2');
    this.field = this.#program(fieldVertex, fieldFragment);
    this.grains = this.#program(grainVertex, grainFragment);
    this.textures = Object.fromEntries(['field', 'columns', 'rows', 'colours', 'sand'].map((name) => [name, this.#texture()]));
    for (const name of ['field', 'colours', 'sand'])
      this.#bind(name, () => { for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.LINEAR); });
    this.#bind('sand', () => gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, palette('sand')));
    this.buffers = { place: gl.createBuffer(), size: gl.createBuffer(), speed: gl.createBuffer() };
    this.empty = gl.createVertexArray();
    this.arrays = gl.createVertexArray();
    this.count = 0;
  }

  #program(vertex, fragment) {
    const { gl } = this, program = gl.createProgram();
    for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    return { program, at: (name) => gl.getUniformLocation(program, name) };
  }

  #texture() {
    const { gl } = this, texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, wrap, gl.CLAMP_TO_EDGE);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    return texture;
  }

  #bind(name, then) {
    this.gl.bindTexture(this.gl.TEXTURE_2D, this.textures[name]);
    then();
  }

  /// Texture coordinate of each place along a direction: 0.5 / n at the first centre, piecewise linear between centres.
  #table(name, faces) {
    const { gl } = this, n = faces.length - 1, length = faces[n] - faces[0];
    const table = new Float32Array(lookups);
    for (let k = 0, cell = 0; k < lookups; ++k) {
      const s = faces[0] + (k / (lookups - 1)) * length;
      const centre = (c) => 0.5 * (faces[c] + faces[c + 1]);
      while (cell < n - 2 && s > centre(cell + 1)) ++cell;
      table[k] = n < 2 ? 0.5 : (cell + 0.5 + (s - centre(cell)) / (centre(cell + 1) - centre(cell))) / n;
    }
    this.#bind(name, () => gl.texImage2D(gl.TEXTURE_2D, 0, gl.R32F, lookups, 1, 0, gl.RED, gl.FLOAT, table));
  }

  /// The frame (field.js) with the values to colour its cells by, between `from` and `to`.
  load(frame, values, from, to, map) {
    const { gl } = this;
    this.box = [frame.x[0], frame.y[0], frame.x[frame.nx], frame.y[frame.ny]];
    const scale = 255 / (to - from);
    const bytes = Uint8ClampedArray.from(values, (v) => (v - from) * scale);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    this.#bind('field', () => gl.texImage2D(gl.TEXTURE_2D, 0, gl.R8, frame.nx, frame.ny, 0, gl.RED, gl.UNSIGNED_BYTE, new Uint8Array(bytes.buffer)));
    this.#bind('colours', () => gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, palette(map)));
    this.#table('columns', frame.x);
    this.#table('rows', frame.y);
    if (this.frame === frame) return;
    this.frame = frame;
    this.count = frame.grains;
    if (!this.count) return;
    const { grain_x: x, grain_y: y, grain_d: d, grain_speed: speed } = frame.pack;
    const places = new Uint16Array(2 * this.count);
    for (let n = 0; n < this.count; ++n) { places[2 * n] = x.raw[n]; places[2 * n + 1] = y.raw[n]; }
    for (const [name, data] of [['place', places], ['size', d.raw], ['speed', speed.raw]]) {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[name]);
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
    }
    this.grainScales = { span: [x.from, y.from, x.to, y.to], diameters: [d.from, d.to], speeds: [speed.from, speed.to] };
  }

  /// Draws the window {x0, y0, x1, y1} [m]; grains are coloured up to the speed `grainEnd`; paper: colour outside, 0 to 1.
  draw(window, { grains = true, grainEnd = 1, paper = [1, 1, 1] } = {}) {
    if (!this.frame) return;
    const { gl, canvas, field } = this;
    const view = [window.x0, window.y0, window.x1, window.y1];
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.disable(gl.BLEND);
    gl.useProgram(field.program);
    gl.bindVertexArray(this.empty);
    ['field', 'columns', 'rows', 'colours'].forEach((name, unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, this.textures[name]);
      gl.uniform1i(field.at(name), unit);
    });
    gl.uniform4fv(field.at('window'), view);
    gl.uniform4fv(field.at('box'), this.box);
    gl.uniform3fv(field.at('paper'), paper);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    if (grains && this.count) this.#drawGrains(view, grainEnd);
    gl.activeTexture(gl.TEXTURE0);
  }

  #drawGrains(view, grainEnd) {
    const { gl, canvas, grains } = this;
    const { span, diameters, speeds } = this.grainScales;
    const quads = (diameters[1] * canvas.width) / (view[2] - view[0]) > 58;
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.useProgram(grains.program);
    gl.bindVertexArray(this.arrays);
    for (const [name, buffer, parts, type] of [['grain', 'place', 2, gl.UNSIGNED_SHORT], ['size', 'size', 1, gl.UNSIGNED_BYTE], ['speed', 'speed', 1, gl.UNSIGNED_SHORT]]) {
      const at = gl.getAttribLocation(grains.program, name);
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[buffer]);
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, parts, type, true, 0, 0);
      gl.vertexAttribDivisor(at, quads ? 1 : 0);
    }
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.textures.sand);
    gl.uniform1i(grains.at('colours'), 0);
    gl.uniform4fv(grains.at('window'), view);
    gl.uniform4fv(grains.at('span'), span);
    gl.uniform2fv(grains.at('diameters'), diameters);
    gl.uniform2f(grains.at('pixels'), canvas.width, canvas.height);
    gl.uniform1f(grains.at('slow'), speeds[0]);
    gl.uniform1f(grains.at('fastest'), speeds[1]);
    gl.uniform1f(grains.at('end'), grainEnd);
    gl.uniform1i(grains.at('quads'), quads ? 1 : 0);
    if (quads) gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, this.count);
    else gl.drawArrays(gl.POINTS, 0, this.count);
  }
}

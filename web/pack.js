// Numbers as the program packs them: src/report/pack.hpp has the format.

const types = { f4: Float32Array, u2: Uint16Array, u1: Uint8Array };

/// {head, NAME: {raw, from, to}} of a block of bytes; single-precision arrays have no from and to.
export function unpack(buffer) {
  const size = new DataView(buffer).getUint32(4, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 8, size)));
  const pack = { head };
  let at = 8 + size;
  for (const { name, type, count, from, to } of head.arrays) {
    const raw = new types[type](buffer, at, count);
    at += Math.ceil(raw.byteLength / 4) * 4;
    pack[name] = { raw, from, to };
  }
  return pack;
}

/// The values of a packed array.
export function numbers({ raw, from, to }) {
  if (raw instanceof Float32Array) return raw;
  const scale = (to - from) / (2 ** (8 * raw.BYTES_PER_ELEMENT) - 1);
  const values = new Float32Array(raw.length);  // a loop: Float32Array.from takes ten times as long
  for (let n = 0; n < raw.length; ++n) values[n] = from + raw[n] * scale;
  return values;
}

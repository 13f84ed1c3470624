// The matrix of a white balance: light of a temperature and tint becomes white, in linear sRGB.
// Planckian locus by Krystek 1985 in CIE 1960 uv, adaptation by Bradford.

const kReferenceKelvin = 6500;
const kTintStep = 0.0002; // distance from the locus in uv for one step of the tint slider

const kXyzFromRgb = [
  [0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.072175],
  [0.0193339, 0.119192, 0.9503041]];
const kConesFromXyz = [
  [0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]];

/// Nine numbers in columns, as uniformMatrix3fv takes them. The identity at 6500 K without tint.
export function whiteBalance(kelvin, tint) {
  if (kelvin === kReferenceKelvin && tint === 0) return [1, 0, 0, 0, 1, 0, 0, 0, 1];
  const from = transform(kConesFromXyz, whiteXyz(kelvin, tint));
  const to = transform(kConesFromXyz, whiteXyz(kReferenceKelvin, 0));
  const conesFromRgb = multiply(kConesFromXyz, kXyzFromRgb);
  const scaled = conesFromRgb.map((row, i) => row.map((value) => (value * to[i]) / from[i]));
  const matrix = multiply(invert(conesFromRgb), scaled);
  return [0, 1, 2].flatMap((column) => matrix.map((row) => row[column]));
}

/// The product of such a matrix and a colour.
export function balanced(matrix, r, g, b) {
  return [
    matrix[0] * r + matrix[3] * g + matrix[6] * b,
    matrix[1] * r + matrix[4] * g + matrix[7] * b,
    matrix[2] * r + matrix[5] * g + matrix[8] * b];
}

function whiteXyz(kelvin, tint) {
  const [u, v] = locus(kelvin);
  const [u1, v1] = locus(kelvin + 1);
  const length = Math.hypot(u1 - u, v1 - v);
  const shift = tint * kTintStep;
  const us = u + (shift * (v1 - v)) / length; // positive tint: greenish light becomes white
  const vs = v - (shift * (u1 - u)) / length;
  const x = (3 * us) / (2 * us - 8 * vs + 4);
  const y = (2 * vs) / (2 * us - 8 * vs + 4);
  return [x / y, 1, (1 - x - y) / y];
}

function locus(t) {
  return [
    (0.860117757 + 1.54118254e-4 * t + 1.28641212e-7 * t * t) /
      (1 + 8.42420235e-4 * t + 7.08145163e-7 * t * t),
    (0.317398726 + 4.22806245e-5 * t + 4.20481691e-8 * t * t) /
      (1 - 2.89741816e-5 * t + 1.61456053e-7 * t * t)];
}

function transform(m, v) {
  return m.map((row) => row[0] * v[0] + row[1] * v[1] + row[2] * v[2]);
}

function multiply(a, b) {
  return a.map((row) => [0, 1, 2].map(
    (column) => row[0] * b[0][column] + row[1] * b[1][column] + row[2] * b[2][column]));
}

function invert(m) {
  const minor = (r, c) => {
    const [r1, r2] = [(r + 1) % 3, (r + 2) % 3];
    const [c1, c2] = [(c + 1) % 3, (c + 2) % 3];
    return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
  };
  const determinant = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  return [0, 1, 2].map((r) => [0, 1, 2].map((c) => minor(c, r) / determinant));
}

// Rotations as matrices, three rows each; angles in degrees, by the right hand about +x, +y and +z.

export const NONE = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
export const applied = (matrix, [x, y, z]) => matrix.map((row) => row[0] * x + row[1] * y + row[2] * z);
export const transposed = (matrix) => [0, 1, 2].map((i) => matrix.map((row) => row[i]));
export const product = (...all) => all.reduce((a, b) => transposed(transposed(b).map((column) => applied(a, column))));

export function about(axis, degrees) {
  const angle = (degrees * Math.PI) / 180;
  const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
  const matrix = NONE.map((row) => [...row]);
  matrix[u][u] = matrix[v][v] = Math.cos(angle);
  matrix[v][u] = Math.sin(angle);
  matrix[u][v] = -matrix[v][u];
  return matrix;
}

// Three angles, about x, y and z, as one rotation; order: of its factors, so that the last axis turns first.
export const ofAngles = (angles, order) => product(...order.map((axis) => about(axis, angles[axis])));

// The angles of a rotation. Where two of the axes fall together, the last of the order has none.
export function anglesOf(matrix, order) {
  const [a, b, c] = order;
  const sign = (b - a + 3) % 3 === 1 ? 1 : -1; // of the order: round x, y, z or against
  const sine = Math.max(-1, Math.min(1, sign * matrix[a][c]));
  const angles = [0, 0, 0];
  angles[b] = Math.asin(sine);
  if (1 - Math.abs(sine) > 1e-12) {
    angles[a] = Math.atan2(-sign * matrix[b][c], matrix[c][c]);
    angles[c] = Math.atan2(-sign * matrix[a][b], matrix[a][a]);
  } else angles[a] = Math.atan2(sign * matrix[c][b], matrix[b][b]);
  return angles.map((angle) => (angle * 180) / Math.PI);
}

// JSON as scenes need it: 64-bit seeds survive (JSON.parse would round them to 53 bits), and text
// for people keeps what belongs together, such as a cube, on one line.

const MARK = "\u0000int:";

// Integers that a double cannot hold become BigInt. Throws SyntaxError as JSON.parse does.
export function parseJson(text) {
  const marked = text.replace(/"(?:[^"\\]|\\.)*"|-?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?/g, (token) =>
    /^-?[1-9]\d{15,}$/.test(token) && !Number.isSafeInteger(Number(token))
      ? JSON.stringify(MARK + token)
      : token,
  );
  return JSON.parse(marked, (_key, value) =>
    typeof value === "string" && value.startsWith(MARK) ? BigInt(value.slice(MARK.length)) : value,
  );
}

// On one line.
export function compactJson(value) {
  if (typeof value === "bigint") return String(value);
  if (Array.isArray(value)) return `[${value.map(compactJson).join(", ")}]`;
  if (value !== null && typeof value === "object") {
    const members = Object.entries(value).map(([key, v]) => `${JSON.stringify(key)}: ${compactJson(v)}`);
    return members.length ? `{ ${members.join(", ")} }` : "{}";
  }
  return JSON.stringify(value);
}

// Broken over lines where a line would be longer than 120 columns.
export function prettyJson(value, indent = "") {
  const line = compactJson(value);
  if (value === null || typeof value !== "object" || indent.length + line.length <= 120) return line;
  const inner = indent + "  ";
  if (Array.isArray(value)) {
    return `[\n${value.map((v) => inner + prettyJson(v, inner)).join(",\n")}\n${indent}]`;
  }
  const members = Object.entries(value).map(
    ([key, v]) => `${inner}${JSON.stringify(key)}: ${prettyJson(v, inner)}`,
  );
  return `{\n${members.join(",\n")}\n${indent}}`;
}

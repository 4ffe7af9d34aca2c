// Arithmetic as data: a small language for numbers computed from other numbers, with Python's precedence.
//
// expression := + - * / ** , unary -, parentheses, numbers, names, pi, and the functions below

/**
 * @typedef {{kind: "number", value: number} | {kind: "name", name: string} | {kind: "minus", operand: Tree}
 *   | {kind: "binary", op: string, left: Tree, right: Tree} | {kind: "call", name: string, args: Tree[]}} Tree
 */

/** @type {Record<string, (...numbers: number[]) => number>} */
export const FUNCTIONS = {
  abs: Math.abs,
  sqrt: Math.sqrt,
  exp: Math.exp,
  log: Math.log,
  sin: Math.sin,
  cos: Math.cos,
  tan: Math.tan,
  arccos: Math.acos,
  minimum: Math.min,
  maximum: Math.max,
  floor: Math.floor,
};

/** @type {Record<string, (left: number, right: number) => number>} */
const BINARY = {
  "+": (left, right) => left + right,
  "-": (left, right) => left - right,
  "*": (left, right) => left * right,
  "/": (left, right) => left / right,
  "**": (left, right) => left ** right,
};

const TOKEN = /\s*(?:((?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|([A-Za-z_]\w*)|(\*\*|[-+*/(),]))/y;

/** Text that is no expression. */
export class ExpressionError extends Error {}

/**
 * The expression's tree.
 * @param {string} text
 * @returns {Tree}
 * @throws {ExpressionError} for anything outside the language
 */
export function parse(text) {
  const tokens = tokenize(text);
  let at = 0;
  /** @param {string} wanted */
  const accept = (wanted) => tokens[at] === wanted && ++at > 0;
  /** @param {string} wanted */
  const require = (wanted) => {
    if (!accept(wanted)) throw new ExpressionError(`expected ${wanted} in ${text}`);
  };

  /**
   * @param {string[]} operators
   * @param {() => Tree} operand
   * @returns {Tree}
   */
  const leftToRight = (operators, operand) => {
    let left = operand();
    for (let op = tokens[at]; operators.includes(op); op = tokens[at]) {
      at += 1;
      left = { kind: "binary", op, left, right: operand() };
    }
    return left;
  };
  const sum = () => leftToRight(["+", "-"], product);
  const product = () => leftToRight(["*", "/"], signed);
  /** @returns {Tree} */
  const signed = () => (accept("-") ? { kind: "minus", operand: signed() } : power());
  /** @returns {Tree} */
  const power = () => {
    const base = atom();
    return accept("**") ? { kind: "binary", op: "**", left: base, right: signed() } : base;
  };
  /** @returns {Tree} */
  const atom = () => {
    if (accept("(")) {
      const inner = sum();
      require(")");
      return inner;
    }
    const token = tokens[at++];
    if (token === undefined) throw new ExpressionError(`${text} ends too early`);
    if (/^[\d.]/.test(token)) return { kind: "number", value: Number(token) };
    if (!/^[A-Za-z_]/.test(token)) throw new ExpressionError(`unexpected ${token} in ${text}`);
    if (!accept("(")) return token === "pi" ? { kind: "number", value: Math.PI } : { kind: "name", name: token };
    if (!Object.hasOwn(FUNCTIONS, token)) throw new ExpressionError(`no function ${token}`);
    const args = [sum()];
    while (accept(",")) args.push(sum());
    require(")");
    return { kind: "call", name: token, args };
  };

  const tree = sum();
  if (at !== tokens.length) throw new ExpressionError(`unexpected ${tokens[at]} in ${text}`);
  return tree;
}

/**
 * The names that the expression reads.
 * @param {Tree} tree
 * @returns {Set<string>}
 */
export function names(tree) {
  switch (tree.kind) {
    case "number":
      return new Set();
    case "name":
      return new Set([tree.name]);
    case "minus":
      return names(tree.operand);
    case "binary":
      return new Set([...names(tree.left), ...names(tree.right)]);
    case "call":
      return new Set(tree.args.flatMap((arg) => [...names(arg)]));
  }
}

/**
 * The expression's value.
 * @param {Tree} tree
 * @param {(name: string) => number} value the value of a name
 * @returns {number}
 */
export function evaluate(tree, value) {
  switch (tree.kind) {
    case "number":
      return tree.value;
    case "name":
      return value(tree.name);
    case "minus":
      return -evaluate(tree.operand, value);
    case "binary":
      return BINARY[tree.op](evaluate(tree.left, value), evaluate(tree.right, value));
    case "call":
      return FUNCTIONS[tree.name](...tree.args.map((arg) => evaluate(arg, value)));
  }
}

/** @param {string} text */
function tokenize(text) {
  const tokens = [];
  const source = text.trimEnd();
  TOKEN.lastIndex = 0;
  while (TOKEN.lastIndex < source.length) {
    const start = TOKEN.lastIndex;
    const match = TOKEN.exec(source);
    if (!match) throw new ExpressionError(`unexpected ${source.slice(start).trim()[0]} in ${text}`);
    tokens.push(match[0].trim());
  }
  return tokens;
}

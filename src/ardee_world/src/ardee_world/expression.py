# SPDX-License-Identifier: MIT
"""A user's expression y(x), evaluated from its syntax tree: numbers, x, arithmetic, a few functions."""

import ast
import operator
from typing import Callable

import numpy as np

from ardee_common.errors import GeneratorError

_MAX_LENGTH = 500
_BINARY = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Mod: operator.mod,
    ast.Pow: operator.pow,
}
_UNARY = {ast.UAdd: operator.pos, ast.USub: operator.neg}
_FUNCTIONS = {
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "tanh": np.tanh,
    "atan": np.arctan,
    "exp": np.exp,
    "log": np.log,
    "sqrt": np.sqrt,
    "abs": np.abs,
}
_CONSTANTS = {"pi": np.pi, "e": np.e}
Function = Callable[[np.ndarray], np.ndarray]


def _refuse(text: str, found: str) -> GeneratorError:
    known = ", ".join([*_CONSTANTS, *_FUNCTIONS])
    return GeneratorError(
        f"row expression {text!r}: found {found}, expected numbers, x, + - * / % **, and {known}"
    )


def _value(node: ast.AST, x: np.ndarray, text: str) -> np.ndarray:
    if isinstance(node, ast.Constant) and type(node.value) in (int, float):
        return np.float64(node.value)
    if isinstance(node, ast.Name) and node.id == "x":
        return x
    if isinstance(node, ast.Name) and node.id in _CONSTANTS:
        return np.float64(_CONSTANTS[node.id])
    if isinstance(node, ast.BinOp) and type(node.op) in _BINARY:
        return _BINARY[type(node.op)](_value(node.left, x, text), _value(node.right, x, text))
    if isinstance(node, ast.UnaryOp) and type(node.op) in _UNARY:
        return _UNARY[type(node.op)](_value(node.operand, x, text))
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        if node.func.id in _FUNCTIONS and len(node.args) == 1 and not node.keywords:
            return _FUNCTIONS[node.func.id](_value(node.args[0], x, text))
    raise _refuse(text, repr(ast.unparse(node)))


def parse_expression(text: str) -> Function:
    """Returns y as a function of an array x; both in metres."""
    if len(text) > _MAX_LENGTH:
        raise GeneratorError(
            f"row expression: found {len(text)} characters, expected at most {_MAX_LENGTH}"
        )
    try:
        tree = ast.parse(text, mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        raise _refuse(text, "something that is no expression") from error

    def function(x: np.ndarray) -> np.ndarray:
        try:
            with np.errstate(all="ignore"):
                y = np.broadcast_to(_value(tree, x, text), x.shape).astype(float)
        except (RecursionError, OverflowError) as error:
            raise _refuse(text, "an expression too deep or large") from error
        bad = ~np.isfinite(y)
        if bad.any():
            raise GeneratorError(
                f"row expression {text!r}: found {y[bad][0]} at x = {x[bad][0]:g} m, expected a finite number"
            )
        return y

    return function

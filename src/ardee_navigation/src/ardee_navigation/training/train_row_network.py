# SPDX-License-Identifier: MIT
"""Trains the network that finds crop rows on a data set of ardee_datasets, and writes it as ONNX.

Needs torch. The same data set, seed, epochs and versions on one thread give the same network.
"""
import argparse
import hashlib
import time
from pathlib import Path
from typing import Any, Optional, Sequence

import numpy as np

from ardee_common.cli import Parser, run, say, whole_in
from ardee_common.errors import GeneratorError
from ardee_navigation.training.pictures import SIZE_PX, answer, read_split, varied

_BATCH, _RATE = 16, 2e-3


def _loss(logits: Any, heat: Any) -> Any:
    from torch.nn.functional import binary_cross_entropy_with_logits

    known = ~heat.isnan()
    return binary_cross_entropy_with_logits(logits[:, 0][known], heat[known])


def _batch(pictures: Sequence[np.ndarray], heats: Sequence[np.ndarray]) -> Any:
    import torch

    x = np.stack(pictures).transpose(0, 3, 1, 2).astype(np.float32)
    return torch.from_numpy(x), torch.from_numpy(np.stack([answer(heat) for heat in heats]))


def _validate(network: Any, pictures: np.ndarray, heats: np.ndarray) -> float:
    import torch

    network.eval()
    with torch.no_grad():
        x, heat = _batch(list(pictures), list(heats))
        loss = float(_loss(network(x), heat))
    network.train()
    return loss


def train(args: argparse.Namespace) -> str:
    """Trains and writes the network; returns the file and the data's hash."""
    try:
        import torch

        from ardee_navigation.training.network import RowNetwork
    except ImportError as error:
        raise GeneratorError(f"{error}; expected: pip install torch") from None
    torch.manual_seed(args.seed)
    torch.set_num_threads(1)
    rng = np.random.default_rng(args.seed)
    pictures, heats = read_split(args.data, "train")
    unseen = read_split(args.data, "val")
    manifest = args.data / "manifest.json"
    network = RowNetwork()
    steps = args.epochs * (len(pictures) // _BATCH)
    optimiser = torch.optim.AdamW(network.parameters(), lr=_RATE)
    rate = torch.optim.lr_scheduler.OneCycleLR(optimiser, _RATE, total_steps=steps)
    for epoch in range(1, args.epochs + 1):
        order, losses, start = rng.permutation(len(pictures)), [], time.process_time()
        for first in range(0, len(order) - _BATCH + 1, _BATCH):
            some = order[first : first + _BATCH]
            seen = [varied(pictures[i], heats[i], rng) for i in some]
            x, heat = _batch([one[0] for one in seen], [one[1] for one in seen])
            loss = _loss(network(x), heat)
            optimiser.zero_grad()
            loss.backward()
            optimiser.step()
            rate.step()
            losses.append(float(loss))
        words = f"loss {np.mean(losses):.4f}, unseen fields {_validate(network, *unseen):.4f}"
        say(
            "train_row_network",
            f"epoch {epoch} of {args.epochs}: {words}, {time.process_time() - start:.0f} s",
        )
    network.eval()
    shape = (1, 3, SIZE_PX[1], SIZE_PX[0])
    torch.onnx.utils.export(network, torch.zeros(shape), str(args.output), opset_version=11)
    return f"{args.output} of data {hashlib.sha256(manifest.read_bytes()).hexdigest()}"


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Runs `train_row_network DATA --output FILE.onnx`."""
    parser = Parser(prog="train_row_network", description=(__doc__ or "").splitlines()[0])
    parser.add_argument("data", type=Path, metavar="DATA", help="folder of a data set")
    parser.add_argument("--output", type=Path, required=True, metavar="FILE.onnx", help="network")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="of all random numbers")
    parser.add_argument(
        "--epochs",
        type=whole_in(1, 10_000),
        default=40,
        metavar="N",
        help="how often each picture is shown",
    )
    return run(parser, train, arguments)


if __name__ == "__main__":
    raise SystemExit(main())

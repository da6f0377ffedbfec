# SPDX-License-Identifier: MIT
"""Trains the network that finds crop rows on a data set of ardee_datasets, and writes it as ONNX.

Needs torch. The same data set, seed, epochs and versions on one thread give the same network.
"""
import argparse
import hashlib
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, List, Optional, Sequence, Tuple

import numpy as np

from ardee_common.cli import Parser, run, say, whole_in
from ardee_common.errors import GeneratorError
from ardee_navigation.training.pictures import SIZE_PX, read_split, whole
from ardee_navigation.training.variation import varied

_BATCH, _RATE = 8, 2e-3


def _loss(logits: Any, heat: Any) -> Any:
    from torch.nn.functional import binary_cross_entropy_with_logits

    known = ~heat.isnan()
    return binary_cross_entropy_with_logits(logits[:, 0][known], heat[known])


def _batch(seen: Sequence[Tuple[np.ndarray, np.ndarray]]) -> Any:
    import torch

    x = np.stack([rgb for rgb, _ in seen]).transpose(0, 3, 1, 2).astype(np.float32)
    return torch.from_numpy(x), torch.from_numpy(np.stack([heat for _, heat in seen]))


def _validate(network: Any, unseen: List[Tuple[np.ndarray, np.ndarray]]) -> float:
    """Returns the mean loss in batches of pictures."""
    import torch

    network.eval()
    losses = []
    with torch.no_grad():
        for first in range(0, len(unseen), _BATCH):
            x, heat = _batch(unseen[first : first + _BATCH])
            losses.append(float(_loss(network(x), heat)))
    network.train()
    return float(np.mean(losses))


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
    pictures = read_split(args.data, "train")
    if len(pictures) < _BATCH:
        found = f"found {len(pictures)} pictures of rows in train"
        raise GeneratorError(f"{args.data}: {found}, expected at least {_BATCH}")
    unseen = [whole(picture) for picture in read_split(args.data, "val")]
    manifest = args.data / "manifest.json"
    network = RowNetwork()
    steps = args.epochs * (len(pictures) // _BATCH)
    optimiser = torch.optim.AdamW(network.parameters(), lr=_RATE)
    rate = torch.optim.lr_scheduler.OneCycleLR(optimiser, _RATE, total_steps=steps)
    ahead = ThreadPoolExecutor(1)  # one thread, so that random numbers are drawn in order

    def drawn(some: np.ndarray) -> Any:
        return _batch([varied(pictures[i], rng) for i in some])

    for epoch in range(1, args.epochs + 1):
        order, losses, start = rng.permutation(len(pictures)), [], time.process_time()
        batches = np.split(order[: len(order) // _BATCH * _BATCH], len(order) // _BATCH)
        for x, heat in ahead.map(drawn, batches):
            loss = _loss(network(x), heat)
            optimiser.zero_grad()
            loss.backward()
            optimiser.step()
            rate.step()
            losses.append(float(loss))
        words = f"loss {np.mean(losses):.4f}, unseen fields {_validate(network, unseen):.4f}"
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

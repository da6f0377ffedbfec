# SPDX-License-Identifier: MIT
"""The network that finds crop rows: a small U-Net of 3x3 convolutions that OpenCV's dnn reads."""
import torch
from torch import nn

_CHANNELS = 8, 16, 32, 64, 96


def _block(before: int, after: int, stride: int) -> nn.Sequential:
    layers = []
    for n, step in ((before, stride), (after, 1)):
        layers += [
            nn.Conv2d(n, after, 3, step, 1, bias=False),
            nn.BatchNorm2d(after),
            nn.ReLU(),
        ]
    return nn.Sequential(*layers)


class RowNetwork(nn.Module):
    """Picture float[n, 3, h, w] of 0 to 255, RGB, to the logit of the rows' heat, float[n, 1, h / 2, w / 2]."""

    def __init__(self) -> None:
        super().__init__()
        before = (3, *_CHANNELS)
        self.down = nn.ModuleList(_block(a, b, 2) for a, b in zip(before, _CHANNELS))
        pairs = list(zip(_CHANNELS[::-1], _CHANNELS[-2::-1]))
        self.up = nn.ModuleList(nn.ConvTranspose2d(a, b, 2, 2) for a, b in pairs)
        self.join = nn.ModuleList(_block(2 * b, b, 1) for _, b in pairs)
        self.last = nn.Conv2d(_CHANNELS[0], 1, 1)

    def forward(self, x: torch.Tensor) -> torch.Tensor:
        """Returns the logits of a batch."""
        x = x / 127.5 - 1.0
        kept = []
        for down in self.down:
            x = down(x)
            kept.append(x)
        for up, join, skip in zip(self.up, self.join, kept[-2::-1]):
            x = join(torch.cat((up(x), skip), 1))
        return self.last(x)

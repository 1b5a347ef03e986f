"""The energy of sculpting and its gradient by JAX: JIT-compiled, batched, on the CPU, in doubles.

Prints microseconds a strand, for 500 strands of 90 elements with 3 control points at a time. The
same energy as the `gradient` benchmark; only its speed is compared here.
"""

import time

import jax
import jax.numpy as jnp
import numpy as np

jax.config.update("jax_enable_x64", True)
jax.config.update("jax_platforms", "cpu")

STRANDS, ELEMENTS, CONTROLS = 500, 90, 3


def cross_matrix(q):
    return jnp.array([[0.0, -q[2], q[1]], [q[2], 0.0, -q[0]], [-q[1], q[0], 0.0]])


def walk(carry, element):
    position, axes = carry
    q, length = element[:3], element[3]
    n = jnp.sqrt(q @ q)
    x = n * length
    k = cross_matrix(q)
    k2 = k @ k
    a, b, c = jnp.sin(x) / n, (1.0 - jnp.cos(x)) / n**2, (x - jnp.sin(x)) / n**3
    rotation = jnp.eye(3) + a * k + b * k2
    displacement = (length * jnp.eye(3) + b * k + c * k2)[:, 0]
    position = position + axes @ displacement
    return (position, axes @ rotation), position


def energy(q, rest, lengths, anchors, stiffness):
    elements = jnp.concatenate([q, lengths[:, None]], axis=1)
    start = (jnp.zeros(3), jnp.eye(3))
    _, joints = jax.lax.scan(walk, start, elements)
    at = jnp.array([(k + 1) * ELEMENTS // CONTROLS - 1 for k in range(CONTROLS)])
    return jnp.sum((joints[at] - anchors) ** 2) + stiffness * jnp.sum((q - rest) ** 2)


def main():
    rng = np.random.default_rng(1)
    rest = rng.normal(size=(STRANDS, ELEMENTS, 3)) * 0.1 + np.array([0.3, 0.0, 1.7])
    q = rest + rng.normal(size=rest.shape) * 0.01
    lengths = np.full((STRANDS, ELEMENTS), 0.8)
    anchors = rng.normal(size=(STRANDS, CONTROLS, 3)) * 5.0
    both = jax.jit(jax.vmap(jax.value_and_grad(energy), in_axes=(0, 0, 0, 0, None)))
    arguments = [jnp.asarray(x) for x in (q, rest, lengths, anchors)]
    best = float("inf")
    jax.block_until_ready(both(*arguments, 20.0))
    for _ in range(20):
        start = time.perf_counter()
        jax.block_until_ready(both(*arguments, 20.0))
        best = min(best, time.perf_counter() - start)
    print(f"{best / STRANDS * 1e6:.2f}")


main()

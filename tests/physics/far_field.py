"""far_field.py: an independent model of forces with `theta`, written from lib/spec/far-field.md.

far_field.py PETRI [NAME...]: runs generated scripts with petri and compares all positions and velocities with those of
the model, bit for bit. With NAMEs, only these cases run.
"""
import math
import multiprocessing
import os
import random
import struct
import subprocess
import sys
import tempfile
from collections import namedtuple

MIN_PARTICLES, LEAF, TARGETS, LEVELS, SUMS, SAMPLES = 1024, 32, 64, 42, 8, 64
DELTA = 1 / 64

Particle = namedtuple('Particle', 'group position mass charge radius anchor')
Force = namedtuple('Force', 'group kind strength theta max_distance')


def single(x):
    """Returns a number rounded to single precision."""
    return struct.unpack('f', struct.pack('f', x))[0]


def larger(a, b):
    return b if b > a or math.isnan(b) else a


def divide(a, b):
    """Returns a / b as in IEEE arithmetic, where a division by zero is not an error."""
    if b:
        return a / b
    return math.nan if a == 0 or math.isnan(a) else math.copysign(math.inf, a) * math.copysign(1, b)


def product(a, b):
    return sum_in_order(x * y for x, y in zip(a, b))


def sum_in_order(numbers):
    total = None
    for number in numbers:
        total = number if total is None else total + number
    return total


class Cell:
    def __init__(self, members, children):
        self.members = members
        self.children = children
        self.point = False


class Member:
    def __init__(self, number, source, radius, position):
        self.number = number
        self.source = source
        self.radius = radius
        self.position = position


class Forest:
    """The trees of all groups for one kind of source."""

    def __init__(self, system, kind):
        self.charges = kind == 'electrostatic'
        self.n = system.dimensions
        groups = [self.members(system, group) for group in range(len(system.parents))]
        self.set_cube([member for group in groups for member in group])
        self.trees = [self.make_tree(group) for group in groups]

    def members(self, system, group):
        found = []
        for number in system.members[group]:
            particle = system.particles[number]
            source = particle.charge if self.charges else particle.mass
            if source != 0 and all(map(math.isfinite, system.position[number])):
                found.append(Member(number, source, particle.radius, system.position[number]))
        return found

    def set_cube(self, members):
        axes = range(self.n)
        self.low = [min((m.position[k] for m in members), default=0.0) for k in axes]
        high = [max((m.position[k] for m in members), default=0.0) for k in axes]
        half = max(h * 0.5 - l * 0.5 for h, l in zip(high, self.low))
        self.exponent = max(math.frexp(half)[1] + 1, -400) if half else -400
        for member in members:
            member.scaled = [(x * 0.5 - l * 0.5) * self.power(1) for x, l in zip(member.position, self.low)]
            member.scaled_radius = member.radius * 0.5 * self.power(1)
            places = [int(s * 2.0**LEVELS) for s in member.scaled]
            member.key = [sum((p >> LEVELS - 1 - level & 1) << k for k, p in enumerate(places))
                          for level in range(LEVELS)]

    def power(self, shift):
        return math.ldexp(1.0, shift - self.exponent)

    def make_tree(self, members):
        if not members:
            return None
        return self.make_cell(sorted(members, key=lambda member: member.key))

    def make_cell(self, members):
        first, last = members[0].key, members[-1].key
        children = []
        if len(members) > LEAF and first != last:
            level = next(l for l in range(LEVELS) if first[l] != last[l])
            for digit in range(2**self.n):
                part = [m for m in members if m.key[level] == digit]
                if part:
                    children.append(self.make_cell(part))
        cell = Cell(members, children)
        if children:
            self.set_moments(cell, [(c.weight, c.centre, c.size, c.radius, c.monopole, c.dipole, c.second)
                                    for c in children])
        else:
            none = [[0.0] * self.n for _ in range(self.n)]
            self.set_moments(cell, [(abs(m.source), m.scaled, 0.0, m.scaled_radius, m.source, [0.0] * self.n, none)
                                    for m in members])
            self.check_point(cell)
        cell.quadrupole = self.quadrupole(cell.second)
        return cell

    def check_point(self, cell):
        first = cell.members[0]
        cell.point = all(m.position == first.position for m in cell.members)
        if cell.point:
            cell.centre, cell.size, cell.dipole = first.scaled, 0.0, [0.0] * self.n
            cell.second = [[0.0] * self.n for _ in range(self.n)]

    def set_moments(self, cell, parts):
        n = self.n
        weight, total = 0.0, [0.0] * n
        for part in parts:
            weight += part[0]
            total = [t + part[0] * x for t, x in zip(total, part[1])]
        centre = [divide(t, weight) for t in total]
        size = radius = monopole = 0.0
        dipole, second = [0.0] * n, [[0.0] * n for _ in range(n)]
        for _, at, part_size, part_radius, q, p, s in parts:
            y = [a - c for a, c in zip(at, centre)]
            size = larger(size, math.sqrt(product(y, y)) + part_size)
            radius = larger(radius, part_radius)
            monopole += q
            for k in range(n):
                if self.charges:
                    dipole[k] += p[k] + q * y[k]
                for l in range(k, n):
                    term = q * y[k] * y[l]
                    if self.charges:
                        term = term + p[k] * y[l] + y[k] * p[l]
                    second[k][l] += term
                    second[k][l] += s[k][l]
        cell.weight, cell.centre, cell.size, cell.radius = weight, centre, size, radius
        cell.monopole, cell.dipole, cell.second = monopole, dipole, second

    def quadrupole(self, second):
        n = self.n
        trace = sum_in_order([second[k][k] for k in range(n)] + [0.0] * (3 - n))
        upper = [[3 * second[k][l] - (trace if k == l else 0) for l in range(n)] for k in range(n)]
        return [[upper[min(k, l)][max(k, l)] for l in range(n)] for k in range(n)]


class Sums:
    """The partial sums of a list."""

    def __init__(self, n):
        self.parts = [[0.0] * SUMS for _ in range(n)]
        self.count = 0

    def add(self, vector):
        at = self.count % SUMS
        self.count += 1
        if vector:
            for part, number in zip(self.parts, vector):
                part[at] += number

    def total(self):
        return [((p[0] + p[4]) + (p[2] + p[6])) + ((p[1] + p[5]) + (p[3] + p[7])) for p in self.parts]


class Walk:
    def __init__(self, system, forest, force, box):
        self.system, self.forest, self.force = system, forest, force
        self.low = [min(m.scaled[k] for m in box) for k in range(forest.n)]
        self.high = [max(m.scaled[k] for m in box) for k in range(forest.n)]
        self.radius = max(m.scaled_radius for m in box)
        self.targets = box
        self.cells, self.sources = [], []
        bound = force.max_distance if force.max_distance > 0 else math.inf
        self.bound = bound * 0.5 * forest.power(1)

    def visit(self, cell):
        d2 = g2 = 0.0
        for c, low, high in zip(cell.centre, self.low, self.high):
            near, far = max(low - c, c - high, 0.0), max(c - low, high - c)
            d2 += near * near
            g2 += far * far
        t = self.force.theta * 2 / 3
        reach = cell.size + (cell.radius + self.radius)
        accepted = d2 >= 2.0 ** -80 and cell.size * cell.size < t * t * d2 and reach * reach < d2
        if self.bound < math.inf:
            beyond, within = self.bound * (1 + 2**-40) + cell.size, self.bound * (1 - 2**-40) - cell.size
            if d2 > beyond * beyond:
                return
            accepted = accepted and within > 0 and g2 < within * within
        if accepted:
            self.cells.append(cell)
        elif cell.children:
            for child in cell.children:
                self.visit(child)
        elif not (cell.point and all(any(t is m for m in cell.members) for t in self.targets)):
            self.sources += cell.members

    def cell_term(self, target, cell):
        d = [c - s for c, s in zip(cell.centre, target.scaled)]
        a = product(d, d)
        y = single(1 / single(math.sqrt(single(a))))
        i1 = y * (1.5 - 0.5 * a * (y * y))
        i2 = i1 * i1
        i3 = i1 * i2
        i5 = i3 * i2
        w = [product(row, d) for row in cell.quadrupole]
        z = cell.monopole * i3 + 2.5 * product(d, w) * (i5 * i2)
        if not self.forest.charges:
            return [x * z - v * i5 for x, v in zip(d, w)]
        z = z - 3 * product(cell.dipole, d) * i5
        return [x * z - v * i5 + p * i3 for x, v, p in zip(d, w, cell.dipole)]

    def apply(self):
        strength = self.system.strength(self.force)
        for target in self.targets:
            if self.system.particles[target.number].anchor:
                continue
            near, far = Sums(self.forest.n), Sums(self.forest.n)
            for source in self.sources:
                near.add(self.system.pair(self.force, target.number, source.number))
            for cell in self.cells:
                far.add(self.cell_term(target, cell))
            force = near.total()
            if self.cells:
                side = self.forest.power(0)
                force = [f + strength * (target.source * (c * side * side)) for f, c in zip(force, far.total())]
            self.system.add_force(target.number, force)


def target_groups(cell):
    if len(cell.members) <= TARGETS:
        return [cell.members]
    if cell.children:
        return [group for child in cell.children for group in target_groups(child)]
    return [cell.members[at:at + TARGETS] for at in range(0, len(cell.members), TARGETS)]


class System:
    def __init__(self, dimensions, parents, particles, forces):
        self.dimensions, self.parents, self.particles, self.forces = dimensions, parents, particles, forces
        self.position = [list(p.position) for p in particles]
        self.velocity = [[0.0] * dimensions for _ in particles]
        self.members = [[i for i, p in enumerate(particles) if p.group == g] for g in range(len(parents))]

    @staticmethod
    def strength(force):
        return -force.strength if force.kind == 'electrostatic' else force.strength

    def source(self, force, number):
        particle = self.particles[number]
        return particle.charge if force.kind == 'electrostatic' else particle.mass

    def pair(self, force, i, j):
        """Returns the force of particle j on particle i, or None."""
        q, p = self.source(force, i), self.source(force, j)
        d = [b - a for a, b in zip(self.position[i], self.position[j])]
        length = math.sqrt(product(d, d)) if q and p else 0.0
        if not 0 < length <= sys.float_info.max or (force.max_distance > 0 and not length < force.max_distance):
            return None
        distance = max(self.particles[i].radius + self.particles[j].radius, length)
        k = self.strength(force) * (q * p) / (distance * distance)
        inverse = 1 / length
        return [x * inverse * k for x in d]

    def add_force(self, i, vector, sign=1):
        self.force[i] = [f + v if sign > 0 else f - v for f, v in zip(self.force[i], vector)]

    def add_pair(self, forces, i, j):
        for force in forces:
            vector = self.pair(force, i, j)
            if vector:
                self.add_force(i, vector)
                self.add_force(j, vector, -1)

    def above(self, group, level):
        """Returns the groups that enclose a group, up to a level, and have particles."""
        found = []
        while group != level:
            group = self.parents[group]
            if self.members[group]:
                found.append(group)
        return found

    def exact_pass(self, group, outer, forces):
        own = self.members[group]
        for at, i in enumerate(own):
            for j in own[at + 1:] + [j for g in outer for j in self.members[g]]:
                self.add_pair(forces, i, j)

    def forest(self, force):
        forest = self.forests.setdefault(force.kind, None) or Forest(self, force.kind)
        self.forests[force.kind] = forest
        return forest

    def sampled_pairs(self, force, targets, sources):
        """Returns an estimate of the number of exact pairs."""
        forest = self.forest(force)
        if not forest.trees[targets] or not forest.trees[sources]:
            return 0
        boxes = target_groups(forest.trees[targets])
        step, pairs = 1 + len(boxes) // SAMPLES, 0
        for box in boxes[::step]:
            walk = Walk(self, forest, force, box)
            walk.visit(forest.trees[sources])
            pairs += len(walk.sources) * sum(not self.particles[target.number].anchor for target in box)
        return pairs * step

    def tree_pays(self, force, group, other):
        size = len(self.members[other])
        if size < MIN_PARTICLES:
            return False
        ways = {(group, other), (other, group)}
        pairs = sum(self.sampled_pairs(force, *way) for way in ways)
        return pairs * 4 <= len(ways) * len(self.members[group]) * size * 3

    def far(self, force, targets, sources):
        forest = self.forest(force)
        if not forest.trees[targets] or not forest.trees[sources]:
            return
        for box in target_groups(forest.trees[targets]):
            walk = Walk(self, forest, force, box)
            walk.visit(forest.trees[sources])
            walk.apply()

    def far_pass(self, group, outer, force):
        if self.tree_pays(force, group, group):
            self.far(force, group, group)
        else:
            self.exact_pass(group, [], [force])
        for other in outer:
            if not self.tree_pays(force, group, other):
                for i in self.members[group]:
                    for j in self.members[other]:
                        self.add_pair([force], i, j)
            else:
                self.far(force, group, other)
                self.far(force, other, group)

    def passes(self, group):
        levels = [group]
        while levels[-1]:
            levels.append(self.parents[levels[-1]])
        for level in levels:
            forces = [f for f in self.forces if f.group == level]
            divided = len(self.members[group]) >= MIN_PARTICLES and any(f.theta for f in forces)
            exact = [f for f in forces if not (divided and f.theta)]
            outer = self.above(group, level)
            if exact:
                self.exact_pass(group, outer, exact)
            for force in forces:
                if divided and force.theta:
                    self.far_pass(group, outer, force)

    def step(self):
        self.force = [[0.0] * self.dimensions for _ in self.particles]
        self.forests = {}
        for group in range(len(self.parents)):
            if self.members[group]:
                self.passes(group)
        for i, particle in enumerate(self.particles):
            if particle.anchor:
                continue
            if particle.mass and all(map(math.isfinite, self.force[i])):
                c = DELTA / particle.mass
                self.velocity[i] = [v + f * c for v, f in zip(self.velocity[i], self.force[i])]
            self.position[i] = [x + v * DELTA for x, v in zip(self.position[i], self.velocity[i])]


# --- scripts

def write_group(lines, system, group, indent):
    space = ' ' * indent
    for force in system.forces:
        if force.group == group:
            lines.append(f'{space}!{force.kind} strength={force.strength!r} theta={force.theta!r} '
                         f'max_distance={force.max_distance!r}')
    for number in system.members[group]:
        p = system.particles[number]
        position = ';'.join(f'({x!r})' if x < 0 else repr(x) for x in p.position)
        lines.append(f'{space}!{"anchor" if p.anchor else "particle"} id={number} position={position} '
                     f'mass={p.mass!r} charge=({p.charge!r}) radius={p.radius!r}')
    for child, parent in enumerate(system.parents):
        if child and parent == group:
            lines.append(f'{space}!group')
            write_group(lines, system, child, indent + 2)


def script(system):
    lines = ['%pragma fps 64', f'!physics state=:s dimensions={system.dimensions}']
    write_group(lines, system, 0, 2)
    return '\n'.join(lines) + '\n'


def run(petri, system, steps):
    """Returns the positions and velocities that petri computes."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'case.fl')
        with open(path, 'w', encoding='utf-8') as file:
            file.write(script(system))
        result = subprocess.run([petri, 'run', path, '--frames', str(steps + 1), '--print', 'state'],
                                stdout=subprocess.PIPE, check=True, encoding='utf-8')
    position, velocity = {}, {}
    for line in result.stdout.splitlines():
        if not line.startswith('$(:s;'):
            continue
        key, value = line[len('$(:s;'):].split(') = ')
        parts = key.split(';')
        if parts[0].isdigit():
            (velocity if parts[1:] else position)[int(parts[0])] = [float(x) for x in value.split(';')]
    return position, velocity


# --- cases

SHAPES = {
    'cube': lambda dice, i, n: [dice.uniform(-5, 5) for _ in range(n)],
    'clusters': lambda dice, i, n: [7.0 * (i % 5) * (k + 1) % 11 + dice.gauss(0, 1e-3 * 10**(i % 3)) for k in range(n)],
    'line': lambda dice, i, n: [0.37 * i * (k + 1) for k in range(n)],
    'points': lambda dice, i, n: [float(i % 3 * (k + 2)) for k in range(n)],
    'far': lambda dice, i, n: [1e9 * (i == 3) + dice.random() for _ in range(n)],
    'shell': lambda dice, i, n: [math.copysign(1, dice.random() - 0.5) + dice.gauss(0, 1e-9) for _ in range(n)],
    # Two points in different cells, as close as doubles allow.
    'close': lambda dice, i, n: ([float(i)] * n if i < 2 else [dice.random() for _ in range(n)] if i % 3 == 2
                                 else [2.0**-41 * (1 - i % 3 * 2.0**-52)] * n),
}
GRAVITY, ELECTROSTATIC = 'gravity', 'electrostatic'


def make(seed, dimensions, count, shape, kinds, parents=(0,), theta=0.7, max_distance=0, heavy=False, neutral=False,
         radius=0.0):
    dice = random.Random(seed)
    particles = []
    for i in range(count):
        mass = dice.choice([0.5, 1.0, 1.5, 0.0 if i % 17 == 0 else 2.0])
        charge = (-1.0)**i if neutral else dice.choice([-1.0, 0.0, 0.5, 2.0])
        particles.append(Particle(i * len(parents) // count, SHAPES[shape](dice, i, dimensions),
                                  1e4 if heavy and i == 5 else mass, charge, radius * dice.random(), i % 23 == 7))
    forces = [Force(g if len(parents) > 2 and g < 2 else 0, kind, dice.uniform(0.1, 2), theta, max_distance)
              for g, kind in enumerate(kinds)]
    return System(dimensions, list(parents), particles, forces)


def cases():
    both = [GRAVITY, ELECTROSTATIC]
    seed = 0
    for count in (2, 30, 1024, 1200):
        for dimensions in (2, 3):
            seed += 1
            yield f'size_{count}_{dimensions}d', make(seed, dimensions, count, 'cube', both)
    for shape in ('clusters', 'line', 'points', 'far', 'shell'):
        for dimensions in (2, 3):
            seed += 1
            kinds = [both[seed % 2]] if shape != 'points' else both
            yield f'{shape}_{dimensions}d', make(seed, dimensions, 1100, shape, kinds, theta=1.1, radius=0.01)
    yield 'close_2d', make(27, 2, 1100, 'close', [GRAVITY], theta=1.1)
    yield 'close_3d', make(28, 3, 1100, 'close', both, theta=1.1)
    yield 'size_1023_3d', make(29, 3, 1023, 'cube', [GRAVITY])
    yield 'small_theta_3d', make(30, 3, 1100, 'cube', [GRAVITY], theta=0.25)
    yield 'size_2000_3d', make(31, 3, 2000, 'cube', [GRAVITY], theta=0.9)
    yield 'size_2000_2d', make(32, 2, 2000, 'clusters', [ELECTROSTATIC], theta=1.5)
    yield 'heavy_3d', make(33, 3, 1100, 'cube', both, heavy=True)
    yield 'neutral_3d', make(34, 3, 1100, 'cube', [ELECTROSTATIC], neutral=True, theta=1.0)
    yield 'neutral_2d', make(35, 2, 1100, 'clusters', [ELECTROSTATIC], neutral=True)
    yield 'large_radii_3d', make(36, 3, 1100, 'cube', both, radius=3.0, theta=1.2)
    yield 'larger_radii_2d', make(43, 2, 1100, 'cube', [GRAVITY], radius=30.0)
    yield 'groups_large_radii_2d', make(44, 2, 2100, 'cube', [ELECTROSTATIC], parents=(0, 0), radius=20.0)
    yield 'many_samples_2d', make(45, 2, 2800, 'cube', [GRAVITY], theta=1.5)
    yield 'max_distance_3d', make(37, 3, 1100, 'cube', both, max_distance=4.0, theta=1.0)
    yield 'max_distance_2d', make(38, 2, 1100, 'cube', both, max_distance=6.5, theta=1.5)
    yield 'groups_3d', make(39, 3, 2100, 'cube', both, parents=(0, 0), theta=1.2)
    yield 'groups_2d', make(40, 2, 2100, 'clusters', both, parents=(0, 0), theta=1.4)
    yield 'small_groups_3d', make(41, 3, 2000, 'cube', both, parents=(0, 0, 1), theta=1.2)
    yield 'uneven_group_3d', make_uneven(42)


def make_uneven(seed):
    """Returns a system whose outer group is too small for a far field, while the inner one is not."""
    system = make(seed, 3, 1200, 'cube', [GRAVITY, ELECTROSTATIC], parents=(0, 0), theta=1.0)
    particles = [p._replace(group=int(i >= 100)) for i, p in enumerate(system.particles)]
    return System(3, system.parents, particles, system.forces)


def compare(case):
    """Returns True if petri and the model agree."""
    petri, name, system = case
    steps = 2 if len(system.particles) <= 1100 and len(system.forces) == 1 else 1
    position, velocity = run(petri, system, steps)
    for _ in range(steps):
        system.step()
    if not all(math.isfinite(number) for force in system.force for number in force):
        print(f'{name}: a force is not finite')
        return False
    for i, particle in enumerate(system.particles):
        for kind, found, expected in (('position', position, system.position), ('velocity', velocity, system.velocity)):
            if particle.anchor or not all(map(math.isfinite, expected[i])):
                continue
            if found.get(i) != expected[i]:
                print(f'{name}: {kind} of particle {i} is {found.get(i)}, but the model has {expected[i]}')
                return False
    return True


def main():
    petri, names = sys.argv[1], sys.argv[2:]
    chosen = [(petri, name, system) for name, system in cases() if not names or name in names]
    with multiprocessing.Pool() as pool:
        failed = pool.map(compare, chosen, chunksize=1).count(False)
    print(f'{len(chosen)} scripts, {failed} differ')
    sys.exit(1 if failed or not chosen else 0)


if __name__ == '__main__':
    main()

# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Validates stages of `windfall export` and compares them with the tables of the same frames; see check-usd."""

import csv
import struct
import sys

from pxr import Gf, Usd, UsdGeom, UsdShade, UsdSkel, UsdValidation

# Greatest difference of a component of an orientation in half precision: half a unit in the last place below one, and
# the rounding of the text.
HALF = 2.5e-4 + 5e-5


def single(text):
    """The number as single precision has it."""
    return struct.unpack("<f", struct.pack("<f", float(text)))[0]


def issues(stage):
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    assert len(validators) > 20, f"only {len(validators)} validators"
    found = UsdValidation.ValidationContext(validators).Validate(stage)
    return [f"{error.GetName()}: {error.GetMessage()}" for error in found]


def compare(stage, rows):
    """Compares every frame of a stage with the rows of its table; how many leaves were compared."""
    leaves = UsdGeom.PointInstancer(stage.GetPrimAtPath("/World/Leaves"))
    prototypes = leaves.GetPrototypesRel().GetTargets()
    compared = 0
    frames = {}
    for row in rows:
        frames.setdefault(int(row["frame"]), []).append(row)
    assert stage.GetStartTimeCode() == min(frames) and stage.GetEndTimeCode() == max(frames), "another range"
    assert leaves.GetPositionsAttr().GetTimeSamples() == sorted(frames), "samples at other frames"
    for frame, rows in frames.items():
        positions = leaves.GetPositionsAttr().Get(frame)
        halves = leaves.GetOrientationsAttr().Get(frame)
        turns = leaves.GetOrientationsfAttr().Get(frame)
        speeds = leaves.GetVelocitiesAttr().Get(frame)
        scales = leaves.GetScalesAttr().Get(frame)
        ids = leaves.GetIdsAttr().Get(frame)
        hidden = set(leaves.GetInvisibleIdsAttr().Get(frame))
        kinds = leaves.GetProtoIndicesAttr().Get(frame)
        for column in (positions, halves, turns, speeds, scales, ids, kinds):
            assert len(column) == len(rows), f"frame {frame}: {len(column)} of {len(rows)} leaves"
        visible = sum(row["state"] != "dormant" for row in rows)
        assert len(leaves.ComputeInstanceTransformsAtTime(frame, frame)) == visible, f"frame {frame}: other leaves are seen"
        for at, row in enumerate(rows):
            where = f"frame {frame}, leaf {at}"
            assert ids[at] == int(row["id"]), f"{where}: id {ids[at]} is not {row['id']}"
            assert 0 <= kinds[at] < len(prototypes), f"{where}: no prototype {kinds[at]}"
            is_cluster = "_cluster_" in prototypes[kinds[at]].name
            assert is_cluster == (row["state"] == "attached"), f"{where}: {prototypes[kinds[at]]} while {row['state']}"
            assert (ids[at] in hidden) == (row["state"] == "dormant"), f"{where}: {row['state']}"
            if row["state"] == "dormant":
                continue
            expected = lambda *names: tuple(single(row[name]) for name in names)
            assert tuple(positions[at]) == expected("x_m", "y_m", "z_m"), f"{where}: {positions[at]}"
            assert tuple(speeds[at]) == expected("vx_m_s", "vy_m_s", "vz_m_s"), f"{where}: {speeds[at]}"
            turn = (*turns[at].GetImaginary(), turns[at].GetReal())
            assert turn == expected("qx", "qy", "qz", "qw"), f"{where}: {turn}"
            half = (*halves[at].GetImaginary(), halves[at].GetReal())
            assert max(abs(a - b) for a, b in zip(half, turn)) <= HALF, f"{where}: {half} is not {turn}"
            compared += 1
    return compared


def compare_particles(stage, path):
    """Compares every frame of the points of a stage with the table of particles; how many were compared."""
    with open(path + "_particles.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    frames = range(int(stage.GetStartTimeCode()), int(stage.GetEndTimeCode()) + 1)
    compared = 0
    for prim, name in (("hot_sparks", "hot sparks"), ("comets", "comets"), ("late", "late")):
        cloud = UsdGeom.Points(stage.GetPrimAtPath(f"/World/Particles/{prim}"))
        assert cloud and cloud.GetPrim().GetDisplayName() == name, f"points of {name}"
        assert cloud.GetWidthsInterpolation() == UsdGeom.Tokens.vertex, "a width for each point"
        ages = UsdGeom.PrimvarsAPI(cloud).GetPrimvar("windfall:age")
        assert ages.GetInterpolation() == UsdGeom.Tokens.vertex, "an age for each point"
        own = {frame: [] for frame in frames}
        for row in rows:
            if row["population"] == name:
                own[int(row["frame"])].append(row)
        for frame, living in own.items():
            points, widths = cloud.GetPointsAttr().Get(frame), cloud.GetWidthsAttr().Get(frame)
            expected = lambda *names: [tuple(single(row[name]) for name in names) for row in living]
            where = f"{name}, frame {frame}"
            assert [tuple(point) for point in points] == expected("x_m", "y_m", "z_m"), f"{where}: points"
            speeds = [tuple(speed) for speed in cloud.GetVelocitiesAttr().Get(frame)]
            assert speeds == expected("vx_m_s", "vy_m_s", "vz_m_s"), f"{where}: velocities"
            assert [(width,) for width in widths] == expected("size_m"), f"{where}: widths"
            assert [(age,) for age in ages.Get(frame)] == expected("age_s"), f"{where}: ages"
            assert list(cloud.GetIdsAttr().Get(frame)) == [int(row["id"]) for row in living], f"{where}: ids"
            compared += len(living)
            extent, whole = cloud.GetExtentAttr().Get(frame), UsdGeom.Points.ComputeExtent(points, widths)
            if not living:
                assert Gf.Range3f(*extent).IsEmpty(), f"{where}: extent of nothing"
                continue
            off = max(abs(a - b) for mine, other in zip(extent, whole) for a, b in zip(mine, other))
            assert off < 1e-5, f"{where}: extent {extent} is not {whole}"
        assert any(own.values()), f"{name} are there"
    late = UsdGeom.Points(stage.GetPrimAtPath("/World/Particles/late"))
    assert len(late.GetPointsAttr().Get(frames[0])) in (0, 20), "a burst is there or not"
    return compared


def check_ways(stage, path):
    """A curve for every comet that is older than a step: from its place, through where it was a frame before, to nothing; how many."""
    with open(path + "_particles.csv", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["population"] == "comets"]
    curves = UsdGeom.BasisCurves(stage.GetPrimAtPath("/World/Histories/comets"))
    assert curves and curves.GetPrim().GetDisplayName() == "comets", "curves"
    assert not stage.GetPrimAtPath("/World/Histories/late"), "no curves of what keeps no samples"
    primvars = UsdGeom.PrimvarsAPI(curves)
    places = {(int(row["frame"]), int(row["id"])): tuple(single(row[name]) for name in ("x_m", "y_m", "z_m")) for row in rows}
    compared = 0
    for frame in range(int(stage.GetStartTimeCode()), int(stage.GetEndTimeCode()) + 1):
        counts, points = curves.GetCurveVertexCountsAttr().Get(frame), curves.GetPointsAttr().Get(frame)
        widths, opacities = curves.GetWidthsAttr().Get(frame), primvars.GetPrimvar("displayOpacity").Get(frame)
        ids, colors = primvars.GetPrimvar("windfall:id").Get(frame), primvars.GetPrimvar("displayColor").Get(frame)
        old = [row for row in rows if int(row["frame"]) == frame and float(row["age_s"]) > 1.5 / 60.0]
        assert list(ids) == [int(row["id"]) for row in old], f"frame {frame}: curves of {len(ids)}, not {len(old)}"
        assert len(counts) == len(ids) == len(colors) and sum(counts) == len(points) == len(widths) == len(opacities), "counts"
        first = 0
        for row, count in zip(old, counts):
            where, number = f"frame {frame}, comet {row['id']}", int(row["id"])
            assert 2 <= count <= 6, f"{where}: {count} points"
            assert tuple(points[first]) == places[frame, number], f"{where}: its head"
            before = places.get((frame - 1, number))
            if before:
                assert count > 2 and tuple(points[first + 2]) == before, f"{where}: where it was"
                compared += 1
            own = list(widths[first : first + count])
            assert abs(own[0] / single(row["size_m"]) - 0.5) < 1e-5 and own == sorted(own, reverse=True), f"{where}: {own}"
            first += count
    return compared


def check_blobs(stage, frames):
    """A ball of slime on its way: closed, as large as its field says, with its colour and velocity."""
    mesh = UsdGeom.Mesh(stage.GetPrimAtPath("/World/Blobs/green_slime"))
    assert mesh and mesh.GetPrim().GetDisplayName() == "green slime", "a mesh"
    guide = UsdGeom.Points(stage.GetPrimAtPath("/World/Particles/green_slime"))
    assert guide.ComputePurpose() == UsdGeom.Tokens.guide, "its points are not drawn besides"
    radius = 0.3 * (1.0 - 0.4 ** (1.0 / 3.0)) ** 0.5
    expected = 4.0 / 3.0 * 3.14159265 * radius**3
    seen = 0
    for frame in range(frames[0], frames[1] + 1):
        points = [Gf.Vec3d(point) for point in mesh.GetPointsAttr().Get(frame)]
        if not points:
            continue
        corners = mesh.GetFaceVertexIndicesAttr().Get(frame)
        valid, why = UsdGeom.Mesh.ValidateTopology(corners, mesh.GetFaceVertexCountsAttr().Get(frame), len(points))
        assert valid, why
        found = volume(points, mesh.GetFaceVertexCountsAttr().Get(frame), corners)
        assert abs(found / expected - 1.0) < 0.01, f"frame {frame}: a volume of {found}, not {expected}"
        middle = Gf.Vec3d(*guide.GetPointsAttr().Get(frame)[0])
        assert all(abs((point - middle).GetLength() - radius) < 1e-3 for point in points), "around its particle"
        low, high = mesh.GetExtentAttr().Get(frame)
        assert all(low[axis] - 1e-4 <= point[axis] <= high[axis] + 1e-4 for point in points for axis in range(3)), "extent"
        normals, speeds = mesh.GetNormalsAttr().Get(frame), mesh.GetVelocitiesAttr().Get(frame)
        assert all(Gf.Dot(Gf.Vec3d(normal), point - middle) > 0.99 * radius for normal, point in zip(normals, points)), "outwards"
        assert len(speeds) == len(points) and all(abs(speed[0] - 0.25) < 1e-3 for speed in speeds), "its velocity"
        colors = mesh.GetDisplayColorPrimvar()
        assert colors.GetInterpolation() == UsdGeom.Tokens.vertex and len(colors.Get(frame)) == len(points), "colours"
        seen += 1
    assert seen > 15, f"a surface in {seen} frames"


def check_tree(stage, moment):
    """Bark and joints fit each other, and at rest the skeleton is where it was bound."""
    cache = UsdSkel.Cache()
    roots = [prim for prim in stage.Traverse() if prim.IsA(UsdSkel.Root)]
    assert len(roots) == 2, f"{len(roots)} trees"
    fruit = 0
    for root in roots:
        skeleton = UsdSkel.Skeleton(stage.GetPrimAtPath(root.GetPath().AppendChild("Segments")))
        query = cache.GetSkelQuery(skeleton)
        assert query and query.GetAnimQuery(), "a skeleton with an animation"
        bind = skeleton.GetBindTransformsAttr().Get()
        rest = UsdSkel.ConcatJointTransforms(query.GetTopology(), skeleton.GetRestTransformsAttr().Get())
        off = max((a.ExtractTranslation() - b.ExtractTranslation()).GetLength() for a, b in zip(bind, rest))
        assert off < 1e-4, f"joints at rest are {off} m from where they are bound"
        moved = query.ComputeJointSkelTransforms(moment)
        sway = max((a.ExtractTranslation() - b.ExtractTranslation()).GetLength() for a, b in zip(bind, moved))
        assert 1e-6 < sway < 1.0, f"segments sway by {sway} m"
        berries = stage.GetPrimAtPath(root.GetPath().AppendChild("Fruit"))
        if berries:
            joints = UsdSkel.BindingAPI(berries).GetJointIndicesPrimvar().Get()
            assert max(joints) < len(bind) and len(set(joints)) > 5, "berries hang on several segments"
            fruit += 1
    assert fruit == 1, f"{fruit} trees bear fruit"


def volume(points, counts, corners):
    """Volume inside triangles, positive if they face outwards."""
    assert set(counts) == {3}, "triangles"
    triangles = zip(*[iter(corners)] * 3)
    return sum(Gf.Dot(points[a], Gf.Cross(points[b], points[c])) for a, b, c in triangles) / 6.0


def check_objects(stage, frames):
    """A stone that stays, and a ring that rises and goes aside, both closed and facing outwards."""
    # A pyramid a metre wide and 0.75 m high; a ring with radii of 0.25 m and 0.075 m, of 24 by 12 sides.
    for name, expected, off in (("Object_0", 0.25, 1e-3), ("Object_1", 0.0262, 3e-4)):
        mesh = UsdGeom.Mesh(stage.GetPrimAtPath(f"/World/Objects/{name}"))
        points = [Gf.Vec3d(point) for point in mesh.GetPointsAttr().Get()]
        found = volume(points, mesh.GetFaceVertexCountsAttr().Get(), mesh.GetFaceVertexIndicesAttr().Get())
        assert abs(found - expected) < off, f"{name} has a volume of {found}, not {expected}"
        assert len(mesh.GetNormalsAttr().Get()) == len(points), f"{name} has normals"
        low, high = mesh.GetExtentAttr().Get()
        assert all(low[axis] - 1e-4 <= point[axis] <= high[axis] + 1e-4 for point in points for axis in range(3)), "extent"
    first, last = frames
    place = lambda name, frame: UsdGeom.Xformable(stage.GetPrimAtPath(f"/World/Objects/{name}")).ComputeLocalToWorldTransform(frame).ExtractTranslation()
    assert (place("Object_0", last) - Gf.Vec3d(1.0, 0.75, 1.5)).GetLength() < 1e-5, "the stone stands where it is"
    moved = place("Object_1", last) - place("Object_1", first)
    assert moved[0] > 0.3 and moved[2] == 0.0, f"the ring goes by {moved}"
    if first == 0 and last == 30:
        assert (moved - Gf.Vec3d(1.0, 0.5, 0.0)).GetLength() < 1e-4, f"the ring goes by {moved}"


def check_ground(stage):
    """Level water, and ground that is not."""
    heights = {}
    for name in ("Ground", "Water"):
        surface = UsdGeom.Mesh(stage.GetPrimAtPath(f"/World/{name}"))
        points = surface.GetPointsAttr().Get()
        heights[name] = [point[1] for point in points]
        a, b, c = (Gf.Vec3f(points[at]) for at in surface.GetFaceVertexIndicesAttr().Get()[:3])
        assert Gf.Cross(b - a, c - a)[1] > 0, f"{name} shows its upper side"
    assert 0.9 < max(heights["Ground"]) - min(heights["Ground"]) <= 1.01, "hills"
    assert len(set(heights["Water"])) == 1, "level water"


def check_snow(stage, frames):
    """Snow on hills, not on water: faces upwards, as deep as it is said, with an opacity that its material reads."""
    mesh = UsdGeom.Mesh(stage.GetPrimAtPath("/World/Snow"))
    primvars = UsdGeom.PrimvarsAPI(mesh)
    deepest = 0.0
    for frame in frames:
        points, corners = mesh.GetPointsAttr().Get(frame), mesh.GetFaceVertexIndicesAttr().Get(frame)
        valid, why = UsdGeom.Mesh.ValidateTopology(corners, mesh.GetFaceVertexCountsAttr().Get(frame), len(points))
        assert valid, why
        assert len(corners) > 3 * 1000, f"frame {frame}: {len(corners) // 3} triangles"
        for a, b, c in zip(*[iter(corners)] * 3):
            up = Gf.Cross(points[b] - points[a], points[c] - points[a])[1]
            assert abs(up - 1.0 / 64.0) < 1e-5, f"frame {frame}: a triangle upwards, half a cell wide: {up}"
        low, high = mesh.GetExtentAttr().Get(frame)
        assert all(low[axis] - 1e-4 <= point[axis] <= high[axis] + 1e-4 for point in points for axis in range(3)), "extent"
        for name in ("windfall:snow_depth", "displayOpacity"):
            values = primvars.GetPrimvar(name)
            assert values.GetInterpolation() == UsdGeom.Tokens.vertex and len(values.Get(frame)) == len(points), name
        deepest = max(deepest, *primvars.GetPrimvar("windfall:snow_depth").Get(frame))
        opacities = primvars.GetPrimvar("displayOpacity").Get(frame)
        assert 0.0 <= min(opacities) and max(opacities) == 1.0, "opacity"
    material, _ = UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()
    assert material, "snow has a material"
    assert 0.02 < deepest < 2.0, f"snow of {deepest} m"


def check(path):
    stage = Usd.Stage.Open(path + ".usda")
    found = issues(stage)
    assert not found, f"{path}: " + "; ".join(found)
    assert stage.GetDefaultPrim().GetPath() == "/World" and UsdGeom.GetStageMetersPerUnit(stage) == 1.0, "metres"
    assert UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.y and stage.GetTimeCodesPerSecond() == 30.0, "y up, 30 fps"
    with open(path + ".csv", newline="") as file:
        rows = list(csv.DictReader(file))
    compared = compare(stage, rows)
    assert compared > 500, f"only {compared} leaves were there to compare"
    sparks = compare_particles(stage, path)
    assert sparks > 10000, f"only {sparks} particles were there to compare"
    ways = check_ways(stage, path)
    assert ways > 1000, f"only {ways} ways were there to compare"
    check_blobs(stage, (int(stage.GetStartTimeCode()), int(stage.GetEndTimeCode())))
    check_tree(stage, stage.GetEndTimeCode())
    check_ground(stage)
    check_snow(stage, (stage.GetStartTimeCode(), stage.GetEndTimeCode()))
    check_objects(stage, (stage.GetStartTimeCode(), stage.GetEndTimeCode()))
    camera = UsdGeom.Camera(stage.GetPrimAtPath("/World/Camera")).GetCamera(stage.GetStartTimeCode())
    assert 30.0 < camera.GetFieldOfView(Gf.Camera.FOVVertical) < 51.0, "a camera"
    mesh = next(prim for prim in Usd.PrimRange(stage.GetPrimAtPath("/World/Leaves")) if prim.IsA(UsdGeom.Mesh))
    material, _ = UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()
    assert material, "a leaf has a material"
    clips = len(Usd.ClipsAPI(stage.GetPrimAtPath("/World")).GetClipAssetPaths() or [])
    print(f"{path.rsplit('/', 1)[-1]}: no issue, {compared} leaves, {sparks} particles and {ways} ways equal, {clips} value clips")
    return clips, rows


def check_broken(path, rows):
    """What the checks must not let pass: a leaf upside down, a particle, a way and a surface displaced, a shader without an identifier."""
    stage = Usd.Stage.Open(path + ".usda")
    positions = UsdGeom.PointInstancer(stage.GetPrimAtPath("/World/Leaves")).GetPositionsAttr()
    frame = stage.GetEndTimeCode()
    positions.Set([(x, -y, z) for x, y, z in positions.Get(frame)], frame)
    try:
        compare(stage, rows)
    except AssertionError:
        pass
    else:
        sys.exit("leaves below the ground are not reported")
    cloud = UsdGeom.Points(stage.GetPrimAtPath("/World/Particles/hot_sparks")).GetPointsAttr()
    cloud.Set([point + Gf.Vec3f(0, 1e-3, 0) for point in cloud.Get(frame)], frame)
    try:
        compare_particles(stage, path)
    except AssertionError:
        pass
    else:
        sys.exit("displaced particles are not reported")
    ways = UsdGeom.BasisCurves(stage.GetPrimAtPath("/World/Histories/comets")).GetPointsAttr()
    ways.Set([point + Gf.Vec3f(0, 1e-3, 0) for point in ways.Get(frame)], frame)
    try:
        check_ways(stage, path)
    except AssertionError:
        pass
    else:
        sys.exit("displaced ways are not reported")
    surface = UsdGeom.Mesh(stage.GetPrimAtPath("/World/Blobs/green_slime")).GetPointsAttr()
    surface.Set([point + Gf.Vec3f(0, 2e-3, 0) for point in surface.Get(frame)], frame)
    try:
        check_blobs(stage, (int(stage.GetStartTimeCode()), int(frame)))
    except AssertionError:
        pass
    else:
        sys.exit("a displaced surface is not reported")
    shader = next(prim for prim in stage.Traverse() if prim.IsA(UsdShade.Shader))
    UsdShade.Shader(shader).SetShaderId("NoSuchShader")
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    stage.GetRootLayer().defaultPrim = ""
    if not issues(stage):
        sys.exit("a broken stage is not reported")


short, long = sys.argv[1:]
clips, rows = check(short)
assert clips == 0, "a short stage has its samples in one layer"
check_broken(short, rows)
clips, _ = check(long)
assert clips > 1, "a long stage has clips"

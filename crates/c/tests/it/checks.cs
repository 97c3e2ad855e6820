// Checks the binding beyond the example, with the example's scene; exits with 0 when all is right.

using System;
using Palpate;

static class Checks
{
    static void Must(bool right, string what)
    {
        if (!right)
        {
            Console.WriteLine(what);
            Environment.Exit(3);
        }
    }

    static void Refuses(string what, Action call)
    {
        try
        {
            call();
        }
        catch (PalpateException refused)
        {
            Must(refused.Status == Status.BadInput && refused.Message.Length > 0, what);
            return;
        }
        Must(false, what + " was not refused");
    }

    static void Main()
    {
        Refuses("another format", () => Simulation.Parse("format = 2", "é.toml"));
        Refuses("no file", () => Simulation.Open("/no/such/scene.toml"));
        Simulation simulation = Simulation.Parse(PalpateALiver.Scene, "liver.toml");
        Must(simulation.ToolCount == 1 && simulation.ToolName(0) == "right", "tools");
        Must(simulation.ToolName(1) == null, "no second tool");
        Must(simulation.StepLength > 0.0 && simulation.ForceScale > 0.0, "numbers of the scene");
        foreach (string warning in simulation.Warnings)
        {
            Must(warning.Length > 0, "warnings");
        }
        Surface rest = simulation.CopySurface();
        double[] normals = simulation.CopyNormals();
        Must(rest.Vertices.Length == normals.Length && rest.Version == 0, "the surface at rest");

        State state = simulation.NewState();
        simulation.Dispose();
        var touches = new Touch[1];
        var poses = new Pose[1];
        state.Step(0.0, poses, touches);
        Must(!touches[0].Contact && touches[0].Force.Length == 0.0, "nothing is there");
        poses[0].IsThere = true;
        poses[0].Position = new Vector(
            rest.Vertices[0] - 0.004 * normals[0],
            rest.Vertices[1] - 0.004 * normals[1],
            rest.Vertices[2] - 0.004 * normals[2]);
        State before = state.Clone();
        state.Step(0.1, poses, touches);
        Touch first = touches[0];
        Must(first.Contact && !first.Holds && (first.Events & Events.Contact) != 0, "contact");
        Must(Math.Abs(first.Depth - 0.004) < 4e-4, "depth " + first.Depth);
        Must(Math.Abs(first.Normal.Length - 1.0) < 1e-12, "normal");
        double outward = first.Force.X * normals[0] + first.Force.Y * normals[1] + first.Force.Z * normals[2];
        Must(outward > 0.9 * first.Force.Length, "the force points outward");

        var shape = new Surface();
        state.Show(shape);
        double moved = 0.0;
        for (int i = 0; i < shape.Vertices.Length; i++)
        {
            moved = Math.Max(moved, Math.Abs(shape.Vertices[i] - rest.Vertices[i]));
        }
        Must(moved > 1e-3 && shape.Corners.Length == rest.Corners.Length, "the surface moves");

        state.Restore(before);
        state.Step(0.1, poses, touches);
        Must(touches[0].Force.X == first.Force.X && touches[0].Force.Z == first.Force.Z, "the same bits");
        Refuses("a time that goes back", () => state.Step(0.0, poses, touches));
        Refuses("a tool too many", () => state.Step(0.2, new Pose[2], new Touch[2]));
        poses[0].Position.X = double.NaN;
        Refuses("no number", () => state.Step(0.2, poses, touches));
        before.Dispose();
        state.Dispose();
    }
}

// Presses 4 mm into the liver and prints the force at once and after 40 s. How to build it: docs/how_to/unity.md.

using System;
using System.Globalization;
using Palpate;

static class PalpateALiver
{
    internal const string Scene = @"
format = 1
organ = { builtin = ""liver"", builtin_tissue = ""pig-liver"" }
tool = [{ name = ""right"", tip = { shape = ""flat"", radius_m = 0.001 } }]
";

    static int Main()
    {
        try
        {
            using (Simulation simulation = Simulation.Parse(Scene, "liver.toml"))
            using (State state = simulation.NewState())
            {
                // 4 mm below the first vertex, along its inward normal.
                double[] at = simulation.CopySurface().Vertices, outward = simulation.CopyNormals();
                var poses = new Pose[1];
                poses[0].IsThere = true;
                poses[0].Position = new Vector(
                    at[0] - 0.004 * outward[0], at[1] - 0.004 * outward[1], at[2] - 0.004 * outward[2]);

                var touches = new Touch[1];
                double first = 0.0;
                for (int step = 0; step <= 400; step++)
                {
                    state.Step(0.1 * step, poses, touches);
                    if (step == 0)
                    {
                        first = touches[0].Force.Length;
                    }
                }
                Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                    "{0:F4} N at once, {1:F4} N after 40 s", first, touches[0].Force.Length));
                return 0;
            }
        }
        catch (PalpateException refused)
        {
            Console.Error.WriteLine("palpate: " + refused.Message);
            return (int)refused.Status;
        }
    }
}

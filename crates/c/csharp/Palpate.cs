// palpate for C#: tools that meet an organ, over the shared library palpate_c (docs/how_to/unity.md).
//
// Metres, newtons, seconds, double precision, in the scene's right-handed frame. C# 7.3, no unsafe code; the same for
// .NET, Mono and Unity.

using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Palpate
{
    /// <summary>How a call ended.</summary>
    public enum Status
    {
        /// <summary>Success.</summary>
        Ok = 0,
        /// <summary>A failure that is not the fault of the input.</summary>
        Failed = 1,
        /// <summary>The input is invalid.</summary>
        BadInput = 2,
    }

    /// <summary>What happened to a tool in a step.</summary>
    [Flags]
    public enum Events : uint
    {
        /// <summary>It touches the organ, which it did not in the step before.</summary>
        Contact = 1u << 0,
        /// <summary>It no longer touches the organ.</summary>
        Release = 1u << 1,
        /// <summary>It takes hold.</summary>
        Grip = 1u << 2,
        /// <summary>It lets go.</summary>
        GripRelease = 1u << 3,
        /// <summary>Its blade opens at least one layer, or the organ where there are no layers.</summary>
        Cut = 1u << 4,
        /// <summary>It opens the innermost layer.</summary>
        Perforation = 1u << 5,
        /// <summary>Its shaft, not its tip, touches the organ.</summary>
        ShaftContact = 1u << 6,
        /// <summary>It is deeper than the models can be trusted: beyond 10 mm.</summary>
        DepthBeyondTrust = 1u << 7,
        /// <summary>The model gave a force that is no number; it was replaced by zero.</summary>
        NonFiniteForce = 1u << 8,
        /// <summary>Before the step the last cut was closed again.</summary>
        UndoCut = 1u << 11,
        /// <summary>It moved faster than a hand can, and touches anew where it is now.</summary>
        Jump = 1u << 13,
        /// <summary>The organ gave back more work than was done on it.</summary>
        EnergyGain = 1u << 14,
        /// <summary>It opens the outermost layer of the organ at its tip.</summary>
        OpensLayer1 = 1u << 15,
        /// <summary>It opens the second layer from outside.</summary>
        OpensLayer2 = 1u << 16,
        /// <summary>It opens the third layer from outside.</summary>
        OpensLayer3 = 1u << 17,
        /// <summary>It opens the fourth layer from outside.</summary>
        OpensLayer4 = 1u << 18,
        /// <summary>It opens the fifth layer from outside.</summary>
        OpensLayer5 = 1u << 19,
        /// <summary>It opens the sixth layer from outside.</summary>
        OpensLayer6 = 1u << 20,
        /// <summary>Its shaft no longer touches the organ.</summary>
        ShaftRelease = 1u << 21,
        /// <summary>From this step on the direction of its shaft is not known, so that only its tip and jaws touch an organ
        /// that bends.</summary>
        ShaftUnknown = 1u << 22,
        /// <summary>The direction of its shaft is known again.</summary>
        ShaftKnown = 1u << 23,
        /// <summary>No equilibrium of the organ was found: it is at rest again, and the tool has lost what it touched and
        /// held.</summary>
        NoEquilibrium = 1u << 24,
    }

    /// <summary>Three numbers along x, y and z.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Vector
    {
        public double X, Y, Z;

        public Vector(double x, double y, double z)
        {
            X = x;
            Y = y;
            Z = z;
        }

        public double Length
        {
            get { return Math.Sqrt(X * X + Y * Y + Z * Z); }
        }
    }

    /// <summary>A quaternion of length 1 [-].</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Rotation
    {
        public double X, Y, Z, W;
    }

    /// <summary>Where a tool is. The default is a tool that is not there.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Pose
    {
        /// <summary>The tip [m].</summary>
        public Vector Position;
        /// <summary>Takes the tool's frame to the scene's; read if HasOrientation. The shaft runs along +z.</summary>
        public Rotation Orientation;
        /// <summary>How far its jaws are shut, from 0 to 1 [-].</summary>
        public double Grip;
        byte isThere, hasOrientation, cut;

        /// <summary>Whether somebody holds it.</summary>
        public bool IsThere
        {
            get { return isThere != 0; }
            set { isThere = (byte)(value ? 1 : 0); }
        }

        /// <summary>Whether Orientation is stated; else the shaft stands on the surface, or runs to its trocar.</summary>
        public bool HasOrientation
        {
            get { return hasOrientation != 0; }
            set { hasOrientation = (byte)(value ? 1 : 0); }
        }

        /// <summary>Whether its blade is lowered.</summary>
        public bool Cut
        {
            get { return cut != 0; }
            set { cut = (byte)(value ? 1 : 0); }
        }
    }

    /// <summary>What a tool feels after a step.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Touch
    {
        /// <summary>The force of the tissue on it [N].</summary>
        public Vector Force;
        /// <summary>For a loop that is quicker than the steps: the force where the step had the tip [N].</summary>
        public Vector WithPull;
        /// <summary>Rows of the gradient: change of a component of the force with the tip's place [N/m].</summary>
        public Vector GradientX, GradientY, GradientZ;
        /// <summary>The touched point of the surface at rest [m].</summary>
        public Vector Point;
        /// <summary>Unit outward normal of the surface at rest there [-].</summary>
        public Vector Normal;
        /// <summary>How far the tip is below the surface at rest [m].</summary>
        public double Depth;
        /// <summary>Takes the tool's frame to the scene's, as it was stated or found.</summary>
        public Rotation Orientation;
        /// <summary>With how much each of its jaws presses on the tissue between them [N].</summary>
        public double GripForce;
        /// <summary>The torque on it about its tip [N m]: of tissue that bears on the shaft of a tool without a trocar.</summary>
        public Vector Torque;
        /// <summary>What happened to it in this step.</summary>
        public Events Events;
        byte contact, holds;

        /// <summary>Whether its tip touches or its jaws hold.</summary>
        public bool Contact
        {
            get { return contact != 0; }
        }

        /// <summary>Whether its jaws hold tissue.</summary>
        public bool Holds
        {
            get { return holds != 0; }
        }
    }

    /// <summary>A call failed. The message is one sentence: the cause, then how to fix it.</summary>
    public sealed class PalpateException : Exception
    {
        /// <summary>Whether the input is invalid, or something else failed.</summary>
        public Status Status { get; private set; }

        internal PalpateException(Status status, string message) : base(message)
        {
            Status = status;
        }
    }

    /// <summary>An organ and the tools that may touch it. It never changes: any number of threads may use it.</summary>
    public sealed class Simulation : IDisposable
    {
        internal readonly SimulationHandle Handle;

        Simulation(SimulationHandle handle)
        {
            Handle = handle;
        }

        /// <summary>Reads a scene file and prepares it. A whole organ takes from seconds to minutes, unless the folder
        /// <paramref name="responses"/> keeps its answer; null keeps nothing.</summary>
        /// <exception cref="PalpateException">The scene is invalid, or its preparation failed.</exception>
        public static Simulation Open(string path, string responses = null)
        {
            return Opened(responses, (ref Native.Preparation how, out SimulationHandle handle) =>
                Native.palpate_simulation_open(Native.Utf8(path), ref how, out handle));
        }

        /// <summary>The same for the text of a scene; relative paths in it begin in the folder of
        /// <paramref name="name"/>, its name in errors.</summary>
        /// <exception cref="PalpateException">The scene is invalid, or its preparation failed.</exception>
        public static Simulation Parse(string text, string name, string responses = null)
        {
            return Opened(responses, (ref Native.Preparation how, out SimulationHandle handle) =>
                Native.palpate_simulation_open_text(Native.Utf8(text), Native.Utf8(name), ref how, out handle));
        }

        delegate Status Opening(ref Native.Preparation how, out SimulationHandle handle);

        static Simulation Opened(string responses, Opening open)
        {
            Native.CheckAbi();
            byte[] folder = Native.Utf8(responses);
            GCHandle pinned = GCHandle.Alloc(folder, GCHandleType.Pinned);
            try
            {
                var how = new Native.Preparation();
                how.Responses = folder == null ? IntPtr.Zero : pinned.AddrOfPinnedObject();
                SimulationHandle handle;
                Native.Check(open(ref how, out handle));
                return new Simulation(handle);
            }
            finally
            {
                pinned.Free();
            }
        }

        /// <summary>How many tools the scene has.</summary>
        public int ToolCount
        {
            get { return (int)Native.palpate_tool_count(Handle); }
        }

        /// <summary>The name of a tool, counted from 0; null where there is none.</summary>
        public string ToolName(int tool)
        {
            return Native.Text(Native.palpate_tool_name(Handle, (UIntPtr)(uint)tool));
        }

        /// <summary>Warnings about this scene.</summary>
        public string[] Warnings
        {
            get
            {
                var warnings = new string[(int)Native.palpate_warning_count(Handle)];
                for (int i = 0; i < warnings.Length; i++)
                {
                    warnings[i] = Native.Text(Native.palpate_warning(Handle, (UIntPtr)(uint)i));
                }
                return warnings;
            }
        }

        /// <summary>The step that the scene asks for [s]; steps of other lengths are as good.</summary>
        public double StepLength
        {
            get { return Native.palpate_step_length(Handle); }
        }

        /// <summary>The factor by which the scene wants forces felt [-]; the forces of a step are without it.</summary>
        public double ForceScale
        {
            get { return Native.palpate_force_scale(Handle); }
        }

        /// <summary>A copy of the organ at rest.</summary>
        public Surface CopySurface()
        {
            Native.SurfaceView view;
            Native.Check(Native.palpate_simulation_surface(Handle, out view));
            var surface = new Surface();
            surface.Take(view);
            return surface;
        }

        /// <summary>A copy of x, y, z of the unit outward normal at each vertex of the organ at rest [-].</summary>
        public double[] CopyNormals()
        {
            Native.SurfaceView view;
            Native.Check(Native.palpate_simulation_surface(Handle, out view));
            var normals = new double[3 * (int)view.VertexCount];
            Marshal.Copy(Native.palpate_simulation_normals(Handle), normals, 0, normals.Length);
            return normals;
        }

        /// <summary>A state in which nothing was touched yet.</summary>
        public State NewState()
        {
            StateHandle handle;
            Native.Check(Native.palpate_state_new(Handle, out handle));
            return new State(handle);
        }

        /// <summary>Frees it; its states go on.</summary>
        public void Dispose()
        {
            Handle.Dispose();
        }
    }

    /// <summary>All that a step changes. One thread at a time may use it.</summary>
    public sealed class State : IDisposable
    {
        readonly StateHandle handle;

        internal State(StateHandle handle)
        {
            this.handle = handle;
        }

        /// <summary>Takes one step to <paramref name="time"/> [s] with the tools at <paramref name="poses"/>, in the
        /// scene's order, and writes what they feel to <paramref name="touches"/>. Allocates nothing.</summary>
        /// <exception cref="PalpateException">A pose or the time is invalid.</exception>
        public void Step(double time, Pose[] poses, Touch[] touches)
        {
            if (touches.Length < poses.Length)
            {
                throw new ArgumentException("there are fewer touches than poses", "touches");
            }
            Native.Check(Native.palpate_step(handle, time, poses, (UIntPtr)(uint)poses.Length, touches));
        }

        /// <summary>Writes the organ as it is deformed and cut now to <paramref name="surface"/>, which keeps its arrays
        /// while they are long enough.</summary>
        public void Show(Surface surface)
        {
            Native.SurfaceView view;
            Native.Check(Native.palpate_state_surface(handle, out view));
            surface.Take(view);
        }

        /// <summary>Shapes the organ for the eye no more often than every <paramref name="period"/> [s].</summary>
        public void ShowEvery(double period)
        {
            Native.Check(Native.palpate_state_show_every(handle, period));
        }

        /// <summary>A second state that is as this is now.</summary>
        public State Clone()
        {
            StateHandle copy;
            Native.Check(Native.palpate_state_clone(handle, out copy));
            return new State(copy);
        }

        /// <summary>Makes this as <paramref name="from"/> is now.</summary>
        public void Restore(State from)
        {
            Native.Check(Native.palpate_state_restore(handle, from.handle));
        }

        /// <summary>Makes the organ whole and at rest; time begins anew.</summary>
        public void Reset()
        {
            Native.Check(Native.palpate_state_reset(handle));
        }

        /// <summary>Closes the last cut again, in the next step.</summary>
        public void UndoCut()
        {
            Native.Check(Native.palpate_state_undo_cut(handle));
        }

        /// <summary>Frees it.</summary>
        public void Dispose()
        {
            handle.Dispose();
        }
    }

    /// <summary>The triangles of an organ, copied.</summary>
    public sealed class Surface
    {
        /// <summary>x, y, z of each vertex [m].</summary>
        public double[] Vertices = new double[0];
        /// <summary>The three vertices of each triangle, counter-clockwise seen from outside, counted from 0.</summary>
        public int[] Corners = new int[0];
        /// <summary>Another number whenever the triangles are others; 0: they are those at rest.</summary>
        public ulong Version;
        bool taken;

        internal void Take(Native.SurfaceView view)
        {
            Copied(view.Vertices, 3 * (int)view.VertexCount, ref Vertices);
            if (!taken || view.Version != Version)
            {
                int corners = 3 * (int)view.TriangleCount;
                if (Corners.Length != corners)
                {
                    Corners = new int[corners];
                }
                Marshal.Copy(view.Corners, Corners, 0, corners);
                Version = view.Version;
                taken = true;
            }
        }

        static void Copied(IntPtr from, int length, ref double[] to)
        {
            if (to.Length != length)
            {
                to = new double[length];
            }
            Marshal.Copy(from, to, 0, length);
        }
    }

    sealed class SimulationHandle : SafeHandle
    {
        public SimulationHandle() : base(IntPtr.Zero, true) { }

        public override bool IsInvalid
        {
            get { return handle == IntPtr.Zero; }
        }

        protected override bool ReleaseHandle()
        {
            Native.palpate_simulation_free(handle);
            return true;
        }
    }

    sealed class StateHandle : SafeHandle
    {
        public StateHandle() : base(IntPtr.Zero, true) { }

        public override bool IsInvalid
        {
            get { return handle == IntPtr.Zero; }
        }

        protected override bool ReleaseHandle()
        {
            Native.palpate_state_free(handle);
            return true;
        }
    }

    /// <summary>palpate.h as it is.</summary>
    static class Native
    {
        const string Library = "palpate_c";
        /// <summary>PALPATE_ABI of the header that this was written after.</summary>
        const uint Abi = 2;

        [StructLayout(LayoutKind.Sequential)]
        internal struct Preparation
        {
            internal IntPtr Watch, Data, Responses;
            internal ulong Memory;
        }

        [StructLayout(LayoutKind.Sequential)]
        internal struct SurfaceView
        {
            internal IntPtr Vertices;
            internal UIntPtr VertexCount;
            internal IntPtr Corners;
            internal UIntPtr TriangleCount;
            internal ulong Version;
        }

        internal static void CheckAbi()
        {
            uint library = palpate_abi();
            if (library != Abi)
            {
                throw new PalpateException(Status.Failed, "Palpate.cs is for PALPATE_ABI " + Abi + ", the library has " +
                    library + "; take both from one version of palpate");
            }
        }

        internal static void Check(Status status)
        {
            if (status != Status.Ok)
            {
                throw new PalpateException(status, Text(palpate_error_message()));
            }
        }

        internal static byte[] Utf8(string text)
        {
            return text == null ? null : Encoding.UTF8.GetBytes(text + "\0");
        }

        internal static string Text(IntPtr text)
        {
            if (text == IntPtr.Zero)
            {
                return null;
            }
            int length = 0;
            while (Marshal.ReadByte(text, length) != 0)
            {
                length++;
            }
            var bytes = new byte[length];
            Marshal.Copy(text, bytes, 0, length);
            return Encoding.UTF8.GetString(bytes);
        }

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern uint palpate_abi();

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern IntPtr palpate_error_message();

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern Status palpate_simulation_open(byte[] path, ref Preparation how, out SimulationHandle simulation);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern Status palpate_simulation_open_text(byte[] text, byte[] name, ref Preparation how,
            out SimulationHandle simulation);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern void palpate_simulation_free(IntPtr simulation);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern UIntPtr palpate_tool_count(SimulationHandle simulation);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern IntPtr palpate_tool_name(SimulationHandle simulation, UIntPtr tool);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern UIntPtr palpate_warning_count(SimulationHandle simulation);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern IntPtr palpate_warning(SimulationHandle simulation, UIntPtr number);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern double palpate_step_length(SimulationHandle simulation);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern double palpate_force_scale(SimulationHandle simulation);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern Status palpate_simulation_surface(SimulationHandle simulation, out SurfaceView surface);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern IntPtr palpate_simulation_normals(SimulationHandle simulation);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern Status palpate_state_new(SimulationHandle simulation, out StateHandle state);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern Status palpate_state_clone(StateHandle state, out StateHandle copy);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern Status palpate_state_restore(StateHandle state, StateHandle from);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern Status palpate_state_reset(StateHandle state);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern Status palpate_state_undo_cut(StateHandle state);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern Status palpate_state_show_every(StateHandle state, double period);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern void palpate_state_free(IntPtr state);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern Status palpate_step(StateHandle state, double time, [In] Pose[] poses, UIntPtr tools,
            [Out] Touch[] touches);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern Status palpate_state_surface(StateHandle state, out SurfaceView surface);
    }
}

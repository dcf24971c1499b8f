# SPDX-License-Identifier: GPL-3.0-or-later
"""A Slurm of one node, without systemd and munge, that is started and ended here."""
import os
import pathlib
import shutil
import socket
import subprocess
import time

CONFIGURATION = """\
ClusterName=show
SlurmctldHost={host}(127.0.0.1)
AuthType=auth/none
CredType=cred/none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerParameters=sched_interval=2,defer_batch
MpiDefault=none
ReturnToService=2
SlurmUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
SlurmctldPort=6917
SlurmdPort=6918
NodeName={host} NodeAddr=127.0.0.1 CPUs={cores} RealMemory={memory}
PartitionName=all Nodes={host} Default=YES State=UP
"""


class Slurm:
    def __init__(self, folder, cores):
        self.folder, self.cores, self.host = folder, cores, socket.gethostname().split(".")[0]
        self.processes = {}

    def __enter__(self):
        shutil.rmtree(self.folder, ignore_errors=True)
        for name in ("state", "spool"):
            (self.folder / name).mkdir(parents=True)
        with open("/proc/meminfo", encoding="ascii") as stream:
            memory = int(stream.readline().split()[1]) // 1024 * 9 // 10
        text = CONFIGURATION.format(host=self.host, folder=self.folder, cores=self.cores, memory=memory)
        (self.folder / "slurm.conf").write_text(text, encoding="utf-8")
        os.environ["SLURM_CONF"] = str(self.folder / "slurm.conf")
        self.start("slurmctld", "-D")
        self.start("slurmd", "-D", "-N", self.host)
        self.wait_until_up()
        return self

    def __exit__(self, *fault):
        subprocess.run(["scancel", "--user", str(os.geteuid())], check=False)
        for process in reversed(self.processes.values()):
            process.terminate()
        for process in self.processes.values():
            process.wait()
        del os.environ["SLURM_CONF"]

    def start(self, name, *words):
        self.processes[name] = subprocess.Popen([name, *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def wait_until_up(self):
        for _ in range(300):
            said = subprocess.run(["sinfo", "--noheader", "--format=%T"], capture_output=True, text=True, check=False)
            if said.stdout.strip() in ("idle", "mixed", "allocated"):
                return
            time.sleep(0.2)
        raise SystemExit(f"Slurm does not come up; {self.folder}/slurmctld.log and slurmd.log say why")

    def profile(self, source):
        """The profile that brainshift ships; its waits for a file system over a network are not wanted here."""
        folder = self.folder / "profile"
        shutil.copytree(source, folder)
        text = (folder / "config.yaml").read_text(encoding="utf-8").replace("latency-wait: 60", "latency-wait: 5")
        (folder / "config.yaml").write_text(text, encoding="utf-8")
        return pathlib.Path(folder)

    def kill_jobs(self, number):
        """Running jobs, as a node that is lost; how many."""
        said = subprocess.run(["squeue", "--noheader", "--states=RUNNING", "--format=%i"], capture_output=True,
                              text=True, check=True)
        jobs = said.stdout.split()[:number]
        subprocess.run(["scancel", "--signal=KILL", "--full", *jobs], check=True)
        return len(jobs)

    def restart_controller(self):
        self.processes["slurmctld"].kill()
        self.processes["slurmctld"].wait()
        self.start("slurmctld", "-D")
        self.wait_until_up()
